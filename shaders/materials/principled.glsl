// glTF 2.0's metallic-roughness, with KHR_materials_ior, _specular and _clearcoat. material.b: F0 of what is no metal, and F90.
#ifndef PRINCIPLED_GLSL
#define PRINCIPLED_GLSL
#include "materials/phong.glsl"

SHADER_BEGIN

Scattering principled_scattering(Material material, ScatteringContext context) { return phong_scattering(material, context); }

#if RANDOM_WALK
Bsdf principled_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
  vec3 color = texture_color(material.color, context.place) * context.color;
  float metallic = texture_color(material.metallic, context.place).z;
  bsdf.diffuse = color * (1.0f - metallic);
#if HAS_GLOSSY
  vec3 edge = vec3(material.b.w, material.b.w, material.b.w);
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  bsdf.layer = schlick(vec3(material.b), edge);
  bsdf.glossy = schlick(vec3(material.b) * (1.0f - metallic) + color * metallic, edge * (1.0f - metallic) + white * metallic);
  bsdf.roughness = texture_color(material.roughness, context.place).y;
  bsdf.albedo = ggx_albedo(context.cos_view, bsdf.roughness);
#endif
#if HAS_COAT
  bsdf.coat = texture_color(material.coat, context.place).x;
  bsdf.coat_roughness = texture_color(material.coat_roughness, context.place).y;
  bsdf.coat_albedo = ggx_albedo(context.cos_view, bsdf.coat_roughness);
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
