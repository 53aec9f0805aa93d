// Light that the body lets through evenly, to the other side: paper, leaves, a lampshade (KHR_materials_diffuse_transmission). It is coupled
// to the layers on both sides as the diffuse lobe is to its own.
#ifndef TRANSLUCENT_GLSL
#define TRANSLUCENT_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

vec3 translucent_albedo(Bsdf bsdf) {
  vec3 albedo = bsdf.translucent;
#if HAS_GLOSSY
  albedo = albedo * (vec3(1.0f, 1.0f, 1.0f) - layer_albedo(bsdf.layer, bsdf.albedo));
#endif
  return albedo;
}

LobeValue translucent_value(Bsdf bsdf, Directions at) {
  LobeValue result;
  result.density = maximum(-at.i.z, 0.0f) / PI;
  vec3 albedo = bsdf.translucent;
#if HAS_GLOSSY
  albedo = under_layer(bsdf, at, albedo);
#endif
  result.value = albedo * result.density;
  return result;
}

vec3 translucent_direction(Bsdf bsdf, vec3 o, vec2 u, float part) {
  vec3 i = cosine_direction(u);
  return vec3(i.x, i.y, -i.z);
}

SHADER_END
#endif
