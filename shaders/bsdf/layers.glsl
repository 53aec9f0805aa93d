// What lies over other lobes, and how much light that lets through, one way.
#ifndef LAYERS_GLSL
#define LAYERS_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

#define COAT_F0 0.04f

Fresnel coat_fresnel() { return schlick(vec3(COAT_F0, COAT_F0, COAT_F0), vec3(1.0f, 1.0f, 1.0f)); }

#if HAS_COAT
// A direction in the coat's own frame.
vec3 into_coat(Bsdf bsdf, vec3 v) {
#if HAS_BENT_COAT
  if (bsdf.coat_normal.z != 1.0f) v = into_frame(frame_turned_to(bsdf.coat_normal), v);
#endif
  return v;
}

float coat_transmittance(Bsdf bsdf, vec4 albedo) { return 1.0f - mirrored_once(coat_fresnel(), albedo).x * bsdf.coat; }
#endif

// Towards the viewer.
float under_coat(Bsdf bsdf) {
  float left = 1.0f;
#if HAS_COAT
  left = coat_transmittance(bsdf, bsdf.coat_albedo);
#endif
  return left;
}

float under_sheen(Bsdf bsdf) {
  float left = 1.0f;
#if HAS_SHEEN
  left = 1.0f - max_component(bsdf.sheen) * bsdf.sheen_albedo.y;
#endif
  return left;
}

// Of a lobe with so many layers above it: the coat, and under that the sheen.
float under_layers(Bsdf bsdf, uint layers) {
  return (layers > 0u ? under_coat(bsdf) : 1.0f) * (layers > 1u ? under_sheen(bsdf) : 1.0f);
}

SHADER_END
#endif
