// A metal, rough or polished. material.b: n at red, green and blue, and whether these are to be taken; .c: k; .a: the mean reflectance.
#ifndef CONDUCTOR_GLSL
#define CONDUCTOR_GLSL
#include "materials/phong.glsl"

SHADER_BEGIN

Scattering conductor_scattering(Material material, ScatteringContext context) { return phong_scattering(material, context); }

#if RANDOM_WALK
Bsdf conductor_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
#if HAS_GLOSSY
  bsdf.metallic = 1.0f;
  bsdf.metal = schlick(color_of(material, context.place) * context.color, vec3(1.0f, 1.0f, 1.0f));
  if (material.b.w != 0.0f) {
    bsdf.metal.f0 = vec3(material.b);
    bsdf.metal.f90 = material.c;
    bsdf.metal.mean = vec3(material.a);
    bsdf.metal.conductor = true;
  }
  bsdf.roughness = roughness_of(material, context.place).y;
  bsdf.albedo = ggx_albedo(viewed_cosine(context), bsdf.roughness);
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
