// Guaranteed bounds of a function along a piece of a ray. The piece is o + (m + h·s)·d with −1 ≤ s ≤ 1. The bound (a, b, e) of a function f
// on it states |f − (a + b·s)| ≤ e for each s: a line, and a limit on f's distance from it. It is an affine form whose only symbol is s,
// the point on the ray (Comba and Stolfi 1993). Therefore terms in the same s cancel, and e shrinks with h². e includes float32's rounding.
// An unbounded function, as 1/x around 0, has an e beyond all numbers.
#ifndef BOUND_GLSL
#define BOUND_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

// The possible results of a comparison: a bit for yes and one for no.
#define TRUTH_YES 1u
#define TRUTH_NO 2u
#define TRUTH_EITHER 3u

#define BOUND_UNBOUNDED 1.0e30f
#define BOUND_GROW 1.000002f   // rounding of a sum of some eight positive terms
#define BOUND_TINY 1.0e-36f    // the loss of products below the smallest float

// `rounded`: the sum of the absolute values of all results that were rounded on the way to a and b, each as often as it was.
vec3 bound_rounded(float a, float b, float e, float rounded) {
  return vec3(a, b, (e + EPSILON * rounded) * BOUND_GROW + BOUND_TINY);
}
vec3 bound_unbounded() { return vec3(0.0f, 0.0f, BOUND_UNBOUNDED); }
vec3 bound_between(float lower, float upper) {
  return bound_rounded(0.5f * (lower + upper), 0.0f, 0.5f * (upper - lower), 2.0f * (abs(lower) + abs(upper)));
}

float bound_radius(vec3 x) { return (abs(x.y) + x.z) * BOUND_GROW + 4.0f * EPSILON * abs(x.x); }
float bound_low(vec3 x) { return x.x - bound_radius(x); }
float bound_high(vec3 x) { return x.x + bound_radius(x); }

// The coordinate o + t·d of the piece's points.
vec3 bound_of_coordinate(float o, float d, float m, float h) {
  float way = d * m;
  float a = o + way;
  float b = d * h;
  return bound_rounded(a, b, 0.0f, abs(way) + abs(a) + abs(b));
}

// The bound of center + extent · (o + t·d).
vec3 bound_of_placed(float center, float extent, float o, float d, float m, float h) {
  float way = d * m;
  float shift = extent * (o + way);
  float a = center + shift;
  float b = extent * (d * h);
  return bound_rounded(a, b, 0.0f, abs(a) + 2.0f * (abs(shift) + abs(b)) + abs(extent * way));
}

vec3 bound_negate(vec3 x) { return vec3(-x.x, -x.y, x.z); }
vec3 bound_add(vec3 x, vec3 y) {
  float a = x.x + y.x;
  float b = x.y + y.y;
  return bound_rounded(a, b, x.z + y.z, abs(a) + abs(b));
}
vec3 bound_subtract(vec3 x, vec3 y) { return bound_add(x, bound_negate(y)); }
vec3 bound_scale(vec3 x, float factor) {
  float a = factor * x.x;
  float b = factor * x.y;
  return bound_rounded(a, b, abs(factor) * x.z, 2.0f * (abs(a) + abs(b)));
}
// x·factor + shift for |φ(x) − (x·factor + shift)| ≤ e.
vec3 bound_line(vec3 x, float factor, float shift, float e) {
  float a = factor * x.x;
  float b = factor * x.y;
  return bound_rounded(a + shift, b, abs(factor) * x.z + e, 4.0f * (abs(a) + abs(b) + abs(shift) + e));
}

// s² lies in [0, 1]: half of it goes into a.
vec3 bound_multiply(vec3 x, vec3 y) {
  float bent = 0.5f * (x.y * y.y);
  float size_x = abs(x.x) + abs(x.y);
  float size_y = abs(y.x) + abs(y.y);
  return bound_rounded(x.x * y.x + bent, x.x * y.y + x.y * y.x, abs(bent) + x.z * size_y + y.z * (size_x + x.z),
                           2.0f * (size_x * size_y));
}
vec3 bound_square(vec3 x) {
  float bent = 0.5f * (x.y * x.y);
  float size = abs(x.x) + abs(x.y);
  return bound_rounded(x.x * x.x + bent, 2.0f * (x.x * x.y), bent + x.z * (2.0f * size + x.z), 2.0f * (size * size));
}

// The bound of 1 / x: between its chord and the tangent parallel to the chord.
vec3 bound_reciprocal(vec3 x) {
  float low = bound_low(x);
  float high = bound_high(x);
  float near = minimum(abs(low), abs(high));
  float far = maximum(abs(low), abs(high));
  bool bounded = low * high > 0.0f && near > 1.0e-18f && far < 1.0e18f;
  float n = bounded ? near : 1.0f;
  float f = bounded ? far : 1.0f;
  float slope = 1.0f / (n * f);
  float top = 1.0f / n + 1.0f / f;
  float bottom = 2.0f * sqrt(slope);
  float shift = 0.5f * (top + bottom);
  vec3 y = bound_line(x, -slope, low < 0.0f ? -shift : shift, 0.5f * (top - bottom) + 8.0f * EPSILON * top);
  return bounded ? y : bound_unbounded();
}
vec3 bound_absolute(vec3 x) {
  float low = bound_low(x);
  float high = bound_high(x);
  bool both = low < 0.0f && high > 0.0f;
  float slope = both ? (high + low) / (high - low) : low < 0.0f ? -1.0f : 1.0f;
  float top = both ? maximum((1.0f - slope) * high, (1.0f + slope) * -low) : 0.0f;
  return bound_line(x, slope, 0.5f * top, 0.5f * top);
}
// The bound of a square root. The part of x below 0 is outside of the function's domain, and left out.
vec3 bound_square_root(vec3 x) {
  float low = sqrt(maximum(bound_low(x), 0.0f));
  float high = sqrt(maximum(bound_high(x), 0.0f));
  float sum = maximum(low + high, 1.0e-15f);
  float slope = 1.0f / sum;
  float top = 0.25f * sum;
  float bottom = low * high * slope;
  return bound_line(x, slope, 0.5f * (top + bottom), 0.5f * (top - bottom) + 16.0f * EPSILON * top);
}
vec3 bound_minimum(vec3 x, vec3 y) {
  vec3 d = bound_subtract(x, y);
  vec3 mean = bound_scale(bound_subtract(bound_add(x, y), bound_absolute(d)), 0.5f);
  return bound_high(d) <= 0.0f ? x : bound_low(d) >= 0.0f ? y : mean;
}
vec3 bound_maximum(vec3 x, vec3 y) {
  return bound_negate(bound_minimum(bound_negate(x), bound_negate(y)));
}

// e^x, up to the largest float and beyond it.
float bound_exp(float x) { return x > 0.0f ? 1.0f / exp_negative(-x) : exp_negative(x); }
// Taylor's polynomials around a, the last term between its bounds: φ(a + u) = φ(a) + φ'(a)·u + φ''(ξ)·u²/2.
vec3 bound_exponential(vec3 x) {
  float radius = bound_radius(x);
  float top = bound_exp(x.x + radius);
  float middle = bound_exp(x.x);
  float bent = 0.25f * top * radius * radius;
  vec3 y = bound_rounded(middle + bent, middle * x.y, middle * x.z + bent, 16.0f * (middle + middle * abs(x.y) + bent));
  y = radius > 1.0f ? bound_between(0.0f, top * BOUND_GROW) : y;
  return top < 1.0e30f ? y : bound_unbounded();
}
vec3 bound_logarithm(vec3 x) {
  float low = bound_low(x);
  bool bounded = low > 1.0e-18f && bound_high(x) < 1.0e18f;
  float middle = bounded ? x.x : 1.0f;
  float ratio = bounded ? bound_radius(x) / low : 0.0f;
  float bent = 0.25f * ratio * ratio;
  float slope = 1.0f / middle;
  float value = log_positive(middle);
  vec3 y = bound_rounded(value - bent, slope * x.y, slope * x.z + bent, 4.0f * (1.0f + abs(value) + abs(slope * x.y)) + 16.0f * bent);
  return bounded ? y : bound_unbounded();
}
// x^n for x ≥ 0 and n > 0.
vec3 bound_power(vec3 x, float n) {
  float low = bound_low(x);
  float high = maximum(bound_high(x), 0.0f);
  vec3 y = bound_exponential(bound_multiply(vec3(n, 0.0f, EPSILON * n), bound_logarithm(x)));
  // Near 0 between 0 and the chord to the far end, or where it is steep its value there.
  float top = high > 1.0e-30f ? bound_exp(n * log_positive(high)) * (1.0f + 1.0e-6f * (1.0f + n * abs(log_positive(high)))) : 1.0e-30f;
  float slope = n < 1.0f || high < 1.0e-30f ? 0.0f : 0.5f * top / high;
  vec3 near_zero = n < 1.0f ? bound_between(0.0f, top) : bound_line(x, slope, 0.0f, 0.5f * top);
  return low > 0.125f * high ? y : near_zero;
}

vec3 bound_wave(vec3 x, float value, float slope) {
  float radius = bound_radius(x);
  float bent = 0.25f * value * radius * radius;
  float e = abs(slope) * x.z + abs(bent) + radius * radius * radius / 6.0f;
  vec3 y = bound_rounded(value - bent, slope * x.y, e, 8.0f + 4.0f * (abs(slope * x.y) + e));
  return radius < 1.5f && abs(x.x) < 30000.0f && e < 1.0f ? y : vec3(0.0f, 0.0f, 1.0f);
}
vec3 bound_sine(vec3 x) {
  vec2 at = sine_cosine(x.x);
  return bound_wave(x, at.x, at.y);
}
vec3 bound_cosine(vec3 x) {
  vec2 at = sine_cosine(x.x);
  return bound_wave(x, at.y, -at.x);
}

// The angle of (x, y) in (−π, π]: that of the piece's middle, and the arc tangent of the turn from there. The middle's is off by the rounding of (c, s),
// and by that of atan_yx, which is within seven ε: both are among the 16 that are added.
vec3 bound_angle(vec3 y, vec3 x) {
  float length = sqrt(x.x * x.x + y.x * y.x);
  float c = x.x / length;
  float s = y.x / length;
  vec3 along = bound_add(bound_scale(x, c), bound_scale(y, s));
  vec3 across = bound_subtract(bound_scale(y, c), bound_scale(x, s));
  vec3 tangent = bound_multiply(across, bound_reciprocal(along));
  float radius = abs(tangent.x) + bound_radius(tangent);
  vec3 turned = vec3(tangent.x + atan_yx(y.x, x.x), tangent.y, tangent.z + radius * radius * radius / 3.0f);
  turned = bound_rounded(turned.x, turned.y, turned.z, 16.0f + 4.0f * (abs(turned.x) + abs(turned.y)));
  // True if it may jump from π to −π, or if nothing is known.
  bool jumps = bound_low(x) <= 0.0f && bound_low(y) <= 0.0f && bound_high(y) >= 0.0f;
  return !jumps && radius < 1.0f && bound_low(along) > 0.0f ? turned : vec3(0.0f, 0.0f, 3.1415930f);
}

// The bound of floor(x): constant, or one step of the stairs, or the ramp that they are on.
vec3 bound_floor(vec3 x) {
  float low = floor(bound_low(x));
  float high = floor(bound_high(x));
  vec3 ramp = bound_line(x, 1.0f, -0.5f, 0.5f);
  return high - low <= 1.0f ? vec3(0.5f * (low + high), 0.0f, 0.5f * (high - low)) : ramp;
}

uint bound_less(vec3 x, vec3 y) {
  vec3 d = bound_subtract(x, y);
  return bound_high(d) < 0.0f ? TRUTH_YES : bound_low(d) >= 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint bound_less_equal(vec3 x, vec3 y) {
  vec3 d = bound_subtract(x, y);
  return bound_high(d) <= 0.0f ? TRUTH_YES : bound_low(d) > 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint bound_equal(vec3 x, vec3 y) {
  vec3 d = bound_subtract(x, y);
  return bound_high(d) < 0.0f || bound_low(d) > 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint bound_both(uint x, uint y) { return (x & y & TRUTH_YES) | ((x | y) & TRUTH_NO); }
uint bound_either(uint x, uint y) { return ((x | y) & TRUTH_YES) | (x & y & TRUTH_NO); }
uint bound_opposite(uint x) { return x == TRUTH_YES ? TRUTH_NO : x == TRUTH_NO ? TRUTH_YES : TRUTH_EITHER; }

// The bound of a choice: around both values where the condition is not certain.
vec3 bound_choose(uint condition, vec3 x, vec3 y) {
  float apart = 0.5f * (abs(x.x - y.x) + abs(x.y - y.y));
  vec3 around = bound_rounded(0.5f * (x.x + y.x), 0.5f * (x.y + y.y), apart + maximum(x.z, y.z),
                                  4.0f * (abs(x.x) + abs(x.y) + abs(y.x) + abs(y.y)));
  return condition == TRUTH_YES ? x : condition == TRUTH_NO ? y : around;
}

SHADER_END
#endif
