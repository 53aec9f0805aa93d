// Glass and liquids: a smooth surface between two media, unpolarised Fresnel reflectance.
#ifndef DIELECTRIC_GLSL
#define DIELECTRIC_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

// The reflected share; 1 under total internal reflection, which is decided before any square root.
float fresnel_reflectance(float cos_from, float ior_from, float ior_to) {
  float eta = ior_from / ior_to;
  float cos_squared = 1.0f - eta * eta * (1.0f - cos_from * cos_from);
  if (cos_squared <= 0.0f) return 1.0f;
  float cos_to = sqrt(cos_squared);
  float parallel = (ior_to * cos_from - ior_from * cos_to) / (ior_to * cos_from + ior_from * cos_to);
  float crossed = (ior_from * cos_from - ior_to * cos_to) / (ior_from * cos_from + ior_to * cos_to);
  return 0.5f * (parallel * parallel + crossed * crossed);
}

Scattering dielectric_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  bool one_medium = context.ior_from == context.ior_to;
  float reflected = one_medium ? 0.0f : fresnel_reflectance(context.cos_view, context.ior_from, context.ior_to);
  s.specular = texture_color(material.specular, context.uv);
  s.reflected = vec3(reflected, reflected, reflected);
  s.transmitted = vec3(1.0f - reflected, 1.0f - reflected, 1.0f - reflected);
  return s;
}

SHADER_END
#endif
