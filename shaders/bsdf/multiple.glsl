// A rough mirror: what its microfacets throw at each other before it leaves, which is even. Kulla and Conty, "Revisiting Physically Based
// Shading at Imageworks" (SIGGRAPH 2017).
#ifndef MULTIPLE_GLSL
#define MULTIPLE_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

vec3 multiple_albedo(Bsdf bsdf) { return mirrored_often(bsdf.glossy, bsdf.albedo) * (bsdf.albedo.x * bsdf.covered); }

LobeValue multiple_value(Bsdf bsdf, Directions at) {
  float cosine = maximum(at.i.z, 0.0f);
  float rest = bsdf.albedo.x * at.albedo.x / maximum(bsdf.albedo.z, 1.0e-20f);
  LobeValue result;
  result.density = cosine / PI;
  result.value = mirrored_often(bsdf.glossy, bsdf.albedo) * (rest * result.density * bsdf.covered);
  return result;
}

vec3 multiple_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return cosine_direction(u); }

SHADER_END
#endif
