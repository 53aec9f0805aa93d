// Glass and liquids: a smooth surface between two media, unpolarised Fresnel reflectance.
#ifndef DIELECTRIC_GLSL
#define DIELECTRIC_GLSL
#include "bsdf/fresnel.glsl"
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering dielectric_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  bool one_medium = context.ior_from == context.ior_to;
  float reflected = one_medium ? 0.0f : fresnel_reflectance(context.cos_view, context.ior_from, context.ior_to);
  s.specular = texture_color(material.specular, context.place);
  s.reflected = vec3(reflected, reflected, reflected);
  s.transmitted = vec3(1.0f - reflected, 1.0f - reflected, 1.0f - reflected);
  return s;
}

#if RANDOM_WALK
Bsdf dielectric_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = bsdf_of_scattering(scattering);
#if HAS_ROUGH_GLASS
  bsdf.roughness = texture_color(material.roughness, context.place).y;
  if (bsdf.roughness > 0.0f && context.ior_from != context.ior_to) {
    bsdf.mirror = vec3(0.0f, 0.0f, 0.0f);
    bsdf.transmitted = bsdf.mirror;
    bsdf.glass = vec3(1.0f, 1.0f, 1.0f);
    bsdf.ior_from = context.ior_from;
    bsdf.ior_to = context.ior_to;
  }
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
