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

vec3 multiple_albedo(Bsdf bsdf) { return often_of_both(bsdf) * bsdf.albedo.x; }

LobeValue multiple_value(Bsdf bsdf, Directions at) {
  float cosine = maximum(at.i.z, 0.0f);
  float rest = bsdf.albedo.x * at.albedo.x / maximum(bsdf.albedo.z, 1.0e-20f);
  LobeValue result;
  result.density = cosine / PI;
  result.value = often_of_both(bsdf) * (rest * result.density);
  return result;
}

vec3 multiple_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return cosine_direction(u); }

SHADER_END
#endif
