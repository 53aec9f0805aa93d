// Rays against the whole scene. Everything else asks `trace` and `occlusion` and knows no traversal.
// The entry gives load_primitive, KIND_FIRST(name) and KIND_END(name), or SCENE_PRIMITIVES: every primitive as a constant.
#ifndef TRAVERSE_GLSL
#define TRAVERSE_GLSL
#include "ray.glsl"
#include "records.h"

SHADER_BEGIN

void keep_nearer(INOUT(Hit) hit, float t, vec2 uv, uint primitive) {
  // Strictly nearer: primitives come in the order of their index, so that an exact tie stays with the lowest.
  bool nearer = t > 0.0f && t < hit.t;
  hit.t = nearer ? t : hit.t;
  hit.primitive = nearer ? primitive : hit.primitive;
  hit.uv = nearer ? uv : hit.uv;
}

// The nearest hit with t > 0.
Hit trace(Ray ray) {
  Hit hit;
  hit.t = T_MISS;
  hit.primitive = NONE;
  hit.uv = vec2(0.0f, 0.0f);
  vec2 uv = vec2(0.0f, 0.0f);
#ifdef SCENE_PRIMITIVES
#define TRACE_ONE(name, primitive, constants)           \
  {                                                     \
    float t = name##_intersect(constants, ray, uv);     \
    keep_nearer(hit, t, uv, primitive);                 \
  }
  SCENE_PRIMITIVES(TRACE_ONE)
#else
#define TRACE_KIND(name, number)                                     \
  for (uint i = KIND_FIRST(name); i < KIND_END(name); i++) {         \
    float t = name##_intersect(load_primitive(i), ray, uv);          \
    keep_nearer(hit, t, uv, i);                                      \
  }
  SHAPES(TRACE_KIND)
#endif
  return hit;
}

// How much of a shadow ray's light is lost on 0 < t < t_max: the sum of what every primitive on the way weakens it by, in
// −log2 · SHADOW_SCALE, at most SHADOW_OPAQUE. An integer sum does not depend on the order of traversal.
uint occlusion(Ray ray, float t_max) {
  uint sum = 0u;
  vec2 uv = vec2(0.0f, 0.0f);
#ifdef SCENE_PRIMITIVES
#define OCCLUDE_ONE(name, primitive, constants)                                \
  {                                                                            \
    float t = name##_intersect(constants, ray, uv);                            \
    sum = t > 0.0f && t < t_max ? sum + constants.head.z : sum;                \
    sum = sum < SHADOW_OPAQUE ? sum : SHADOW_OPAQUE;                           \
  }
  SCENE_PRIMITIVES(OCCLUDE_ONE)
#else
#define OCCLUDE_KIND(name, number)                                                                \
  for (uint i = KIND_FIRST(name); i < KIND_END(name) && sum < SHADOW_OPAQUE; i++) {               \
    Primitive primitive = load_primitive(i);                                                      \
    float t = name##_intersect(primitive, ray, uv);                                               \
    sum = t > 0.0f && t < t_max ? sum + primitive.head.z : sum;                                   \
    sum = sum < SHADOW_OPAQUE ? sum : SHADOW_OPAQUE;                                              \
  }
  SHAPES(OCCLUDE_KIND)
#endif
  return sum;
}

// The share of light that passes, from what `occlusion` counted.
float visibility(uint occluded) {
  return occluded >= SHADOW_OPAQUE ? 0.0f : exp_negative(float(occluded) * (-0.693147181f / SHADOW_SCALE));
}

SHADER_END
#endif
