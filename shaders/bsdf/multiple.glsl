// A rough mirror: light that leaves it evenly, after its microfacets have reflected it at each other. Kulla and Conty,
// "Revisiting Physically Based Shading at Imageworks" (SIGGRAPH 2017).
#ifndef MULTIPLE_GLSL
#define MULTIPLE_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

// Layer and metal lie beside each other, so each has its own light to and fro.
vec3 often_of_both(Bsdf bsdf) {
  return mirrored_often(bsdf.layer, bsdf.albedo) * bsdf.layered + mirrored_often(bsdf.metal, bsdf.albedo) * bsdf.metallic;
}

// Microfacets of a smooth surface hide each other only where they are seen edge-on, so most of this light is grazing. Chosen by cosine,
// such directions would be rare; this share of all directions is uniform.
float uniform_share(float roughness) { return maximum(1.0f - 3.0f * roughness, 0.0f); }
float between_facets_density(float roughness, float cosine) {
  float uniform_directions = uniform_share(roughness);
  return cosine > 0.0f ? cosine / PI * (1.0f - uniform_directions) + 0.5f / PI * uniform_directions : 0.0f;
}
vec3 between_facets_direction(float roughness, vec2 u, float part) {
  vec3 i = cosine_direction(u);
  if (part < uniform_share(roughness)) i = half_sphere_direction(u);
  return i;
}

vec3 multiple_albedo(Bsdf bsdf) { return often_of_both(bsdf) * bsdf.albedo.x; }

LobeValue multiple_value(Bsdf bsdf, Directions at) {
  float cosine = maximum(at.i.z, 0.0f);
  float rest = bsdf.albedo.x * at.albedo.x / maximum(bsdf.albedo.z, 1.0e-20f);
  LobeValue result;
  result.density = between_facets_density(bsdf.roughness, cosine);
  result.value = often_of_both(bsdf) * (rest * (cosine / PI));
  return result;
}

vec3 multiple_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return between_facets_direction(bsdf.roughness, u, part); }

SHADER_END
#endif
