// The extent and density of the medium around all objects: a box, whose sides may be infinitely far away, with a
// density of exp(−decay · (y − base)) at height y. Integrals along a ray have closed forms: ∫ exp(−x) dx, and its
// inverse.
#ifndef MEDIUM_EXTENT_GLSL
#define MEDIUM_EXTENT_GLSL
#include "materials/media.glsl"
#include "math/math.glsl"

SHADER_BEGIN

#if HAS_MEDIUM_EXTENT
// The part of the ray up to t that is in the box, as the t at which it begins and that at which it ends; both are
// equal where none is.
vec2 extent_interval(Frame frame, vec3 o, vec3 d, float t) {
  // A ray along a side is taken for one that crosses it very far away.
  vec3 slope = vec3(d.x == 0.0f ? 1.0e-30f : d.x, d.y == 0.0f ? 1.0e-30f : d.y, d.z == 0.0f ? 1.0e-30f : d.z);
  vec3 a = (frame.medium_min - o) / slope;
  vec3 b = (frame.medium_max - o) / slope;
  float begin = maximum(minimum(a.x, b.x), maximum(minimum(a.y, b.y), minimum(a.z, b.z)));
  float end = minimum(maximum(a.x, b.x), minimum(maximum(a.y, b.y), maximum(a.z, b.z)));
  begin = minimum(maximum(begin, 0.0f), t);
  return vec2(begin, maximum(minimum(end, t), begin));
}

// The density at height y, which is relative to the eye. More than 80 scale heights below the base it grows no more,
// where nothing is seen through any length of it.
float extent_density(Frame frame, float y) {
  float heights = (y - frame.medium_base) * frame.medium_decay;
  return heights < 0.0f ? 1.0f / exp_negative(maximum(heights, -80.0f)) : exp_negative(-heights);
}

// (1 − e^(−x)) / x for x ≥ 0, where that is at most 0.5: by its series.
float decayed_mean(float x) {
  float p = -2.4801587e-5f;
  p = p * x + 1.9841270e-4f;
  p = p * x - 1.3888889e-3f;
  p = p * x + 8.3333333e-3f;
  p = p * x - 4.1666667e-2f;
  p = p * x + 1.6666667e-1f;
  p = p * x - 0.5f;
  return p * x + 1.0f;
}

// ∫ density from 0 to t along the unit direction d, at most T_MISS. It is taken from the lower end, where the medium is
// densest, so that nothing grows.
float extent_length(Frame frame, vec3 o, vec3 d, float t) {
  vec2 within = extent_interval(frame, o, d, t);
  float distance = within.y - within.x;
  float decay = abs(d.y) * frame.medium_decay;
  float x = decay * distance;
  float share = x < 0.5f ? distance * decayed_mean(x) : (1.0f - exp_negative(-x)) / decay;
  float lowest = o.y + minimum(d.y * within.x, d.y * within.y);
  return distance > 0.0f ? minimum(extent_density(frame, lowest) * share, T_MISS) : 0.0f;
}

// The t at which extent_length reaches `length`, which is less than that of the whole ray. With s = length / density,
// −ln(1 − decay · s) / decay = s · ln(u) / (u − 1), which is Kahan's: the rounding of u is divided out again.
float extent_distance(Frame frame, vec3 o, vec3 d, float length) {
  float begin = extent_interval(frame, o, d, T_MISS).x;
  float s = length / extent_density(frame, o.y + d.y * begin);
  float u = maximum(1.0f - d.y * frame.medium_decay * s, 1.0e-30f);
  return begin + (u == 1.0f ? s : s * (log_positive(u) / (u - 1.0f)));
}
#endif

// The length that the ray up to t would have, with the same transmittance, where the medium has its record's coefficients all along.
float medium_length(Frame frame, uint media, vec3 o, vec3 d, float t) {
#if HAS_MEDIUM_EXTENT
  if (frame.has_medium_extent != 0u && innermost_medium(media) == 0u) return extent_length(frame, o, d, t);
#endif
  return t;
}

// The t at which medium_length is `length`.
float medium_distance(Frame frame, uint media, vec3 o, vec3 d, float length) {
#if HAS_MEDIUM_EXTENT
  if (frame.has_medium_extent != 0u && innermost_medium(media) == 0u) return extent_distance(frame, o, d, length);
#endif
  return length;
}

SHADER_END
#endif
