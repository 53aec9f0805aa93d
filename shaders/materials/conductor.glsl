// A metal, rough or polished.
#ifndef CONDUCTOR_GLSL
#define CONDUCTOR_GLSL
#include "materials/phong.glsl"

SHADER_BEGIN

bool conductor_is_measured(Material material) { return material.b.w != 0.0f; }  // n, k and mean count
vec3 conductor_n(Material material) { return vec3(material.b); }  // at red, green and blue
vec3 conductor_k(Material material) { return material.c; }
vec3 conductor_mean(Material material) { return vec3(material.a); }  // mean of the reflectance

Scattering conductor_scattering(Material material, ScatteringContext context) { return phong_scattering(material, context); }

#if RANDOM_WALK
Bsdf conductor_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
#if HAS_GLOSSY
  bsdf.metallic = 1.0f;
  bsdf.metal = schlick(color_of(material, context.point) * context.color, vec3(1.0f, 1.0f, 1.0f));
  if (conductor_is_measured(material)) {
    bsdf.metal.f0 = conductor_n(material);
    bsdf.metal.f90 = conductor_k(material);
    bsdf.metal.mean = conductor_mean(material);
    bsdf.metal.conductor = true;
  }
  bsdf.roughness = roughness_of(material, context.point).y;
  bsdf.albedo = ggx_albedo(viewed_cosine(context), bsdf.roughness);
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
