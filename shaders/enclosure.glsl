// What a function may be along a piece of a ray, for certain. The piece is o + (m + h·s)·d with −1 ≤ s ≤ 1, and the enclosure (a, b, e) of
// a function f on it says |f − (a + b·s)| ≤ e for each s: a line, and how far f is from it. It is an affine form whose only symbol is the
// place on the ray (Comba and Stolfi 1993), so that what depends on the same place cancels, and e shrinks with h². e has what
// float32 rounds, too. What is not bounded, as 1/x around 0, has an e beyond all numbers.
#ifndef ENCLOSURE_GLSL
#define ENCLOSURE_GLSL
#include "trigonometry.glsl"

SHADER_BEGIN

// What a comparison may be: a bit for yes and one for no.
#define TRUTH_YES 1u
#define TRUTH_NO 2u
#define TRUTH_EITHER 3u

#define ENCLOSURE_UNBOUNDED 1.0e30f
#define ENCLOSURE_GROW 1.000002f   // what a sum of some eight positive terms may round
#define ENCLOSURE_TINY 1.0e-36f    // what products lose below the smallest float

// `rounded`: the sum of the absolute values of all results that were rounded on the way to a and b, each as often as it was.
vec3 enclosure_rounded(float a, float b, float e, float rounded) {
  return vec3(a, b, (e + EPSILON * rounded) * ENCLOSURE_GROW + ENCLOSURE_TINY);
}
vec3 enclosure_unbounded() { return vec3(0.0f, 0.0f, ENCLOSURE_UNBOUNDED); }
vec3 enclosure_between(float lower, float upper) {
  return enclosure_rounded(0.5f * (lower + upper), 0.0f, 0.5f * (upper - lower), 2.0f * (abs(lower) + abs(upper)));
}

float enclosure_radius(vec3 x) { return (abs(x.y) + x.z) * ENCLOSURE_GROW + 4.0f * EPSILON * abs(x.x); }
float enclosure_low(vec3 x) { return x.x - enclosure_radius(x); }
float enclosure_high(vec3 x) { return x.x + enclosure_radius(x); }

// The coordinate o + t·d of the piece's points.
vec3 enclosure_of_coordinate(float o, float d, float m, float h) {
  float way = d * m;
  float a = o + way;
  float b = d * h;
  return enclosure_rounded(a, b, 0.0f, abs(way) + abs(a) + abs(b));
}

// The same of center + extent · (o + t·d).
vec3 enclosure_of_placed(float center, float extent, float o, float d, float m, float h) {
  float way = d * m;
  float aside = extent * (o + way);
  float a = center + aside;
  float b = extent * (d * h);
  return enclosure_rounded(a, b, 0.0f, abs(a) + 2.0f * (abs(aside) + abs(b)) + abs(extent * way));
}

vec3 enclosure_negate(vec3 x) { return vec3(-x.x, -x.y, x.z); }
vec3 enclosure_add(vec3 x, vec3 y) {
  float a = x.x + y.x;
  float b = x.y + y.y;
  return enclosure_rounded(a, b, x.z + y.z, abs(a) + abs(b));
}
vec3 enclosure_subtract(vec3 x, vec3 y) { return enclosure_add(x, enclosure_negate(y)); }
vec3 enclosure_scale(vec3 x, float factor) {
  float a = factor * x.x;
  float b = factor * x.y;
  return enclosure_rounded(a, b, abs(factor) * x.z, 2.0f * (abs(a) + abs(b)));
}
// x·factor + shift for |φ(x) − (x·factor + shift)| ≤ e.
vec3 enclosure_line(vec3 x, float factor, float shift, float e) {
  float a = factor * x.x;
  float b = factor * x.y;
  return enclosure_rounded(a + shift, b, abs(factor) * x.z + e, 4.0f * (abs(a) + abs(b) + abs(shift) + e));
}

// s² lies in [0, 1]: half of it goes into a.
vec3 enclosure_multiply(vec3 x, vec3 y) {
  float bent = 0.5f * (x.y * y.y);
  float size_x = abs(x.x) + abs(x.y);
  float size_y = abs(y.x) + abs(y.y);
  return enclosure_rounded(x.x * y.x + bent, x.x * y.y + x.y * y.x, abs(bent) + x.z * size_y + y.z * (size_x + x.z),
                           2.0f * (size_x * size_y));
}
vec3 enclosure_square(vec3 x) {
  float bent = 0.5f * (x.y * x.y);
  float size = abs(x.x) + abs(x.y);
  return enclosure_rounded(x.x * x.x + bent, 2.0f * (x.x * x.y), bent + x.z * (2.0f * size + x.z), 2.0f * (size * size));
}

// Between its chord and the tangent parallel to it.
vec3 enclosure_reciprocal(vec3 x) {
  float low = enclosure_low(x);
  float high = enclosure_high(x);
  float near = minimum(abs(low), abs(high));
  float far = maximum(abs(low), abs(high));
  bool bounded = low * high > 0.0f && near > 1.0e-18f && far < 1.0e18f;
  float n = bounded ? near : 1.0f;
  float f = bounded ? far : 1.0f;
  float slope = 1.0f / (n * f);
  float top = 1.0f / n + 1.0f / f;
  float bottom = 2.0f * sqrt(slope);
  float shift = 0.5f * (top + bottom);
  vec3 y = enclosure_line(x, -slope, low < 0.0f ? -shift : shift, 0.5f * (top - bottom) + 8.0f * EPSILON * top);
  return bounded ? y : enclosure_unbounded();
}
vec3 enclosure_absolute(vec3 x) {
  float low = enclosure_low(x);
  float high = enclosure_high(x);
  bool both = low < 0.0f && high > 0.0f;
  float slope = both ? (high + low) / (high - low) : low < 0.0f ? -1.0f : 1.0f;
  float top = both ? maximum((1.0f - slope) * high, (1.0f + slope) * -low) : 0.0f;
  return enclosure_line(x, slope, 0.5f * top, 0.5f * top);
}
// Of what is not negative; a part of x below 0 is no part of the function's domain, and left out.
vec3 enclosure_square_root(vec3 x) {
  float low = sqrt(maximum(enclosure_low(x), 0.0f));
  float high = sqrt(maximum(enclosure_high(x), 0.0f));
  float sum = maximum(low + high, 1.0e-15f);
  float slope = 1.0f / sum;
  float top = 0.25f * sum;
  float bottom = low * high * slope;
  return enclosure_line(x, slope, 0.5f * (top + bottom), 0.5f * (top - bottom) + 16.0f * EPSILON * top);
}
vec3 enclosure_minimum(vec3 x, vec3 y) {
  vec3 d = enclosure_subtract(x, y);
  vec3 mean = enclosure_scale(enclosure_subtract(enclosure_add(x, y), enclosure_absolute(d)), 0.5f);
  return enclosure_high(d) <= 0.0f ? x : enclosure_low(d) >= 0.0f ? y : mean;
}
vec3 enclosure_maximum(vec3 x, vec3 y) {
  return enclosure_negate(enclosure_minimum(enclosure_negate(x), enclosure_negate(y)));
}

// e^x, up to the largest float and beyond it.
float enclosure_exp(float x) { return x > 0.0f ? 1.0f / exp_negative(-x) : exp_negative(x); }
// Taylor's polynomials around a, the last term between its bounds: φ(a + u) = φ(a) + φ'(a)·u + φ''(ξ)·u²/2.
vec3 enclosure_exponential(vec3 x) {
  float radius = enclosure_radius(x);
  float top = enclosure_exp(x.x + radius);
  float middle = enclosure_exp(x.x);
  float bent = 0.25f * top * radius * radius;
  vec3 y = enclosure_rounded(middle + bent, middle * x.y, middle * x.z + bent, 16.0f * (middle + middle * abs(x.y) + bent));
  y = radius > 1.0f ? enclosure_between(0.0f, top * ENCLOSURE_GROW) : y;
  return top < 1.0e30f ? y : enclosure_unbounded();
}
vec3 enclosure_logarithm(vec3 x) {
  float low = enclosure_low(x);
  bool bounded = low > 1.0e-18f && enclosure_high(x) < 1.0e18f;
  float middle = bounded ? x.x : 1.0f;
  float ratio = bounded ? enclosure_radius(x) / low : 0.0f;
  float bent = 0.25f * ratio * ratio;
  float slope = 1.0f / middle;
  float value = log_positive(middle);
  vec3 y = enclosure_rounded(value - bent, slope * x.y, slope * x.z + bent, 4.0f * (1.0f + abs(value) + abs(slope * x.y)) + 16.0f * bent);
  return bounded ? y : enclosure_unbounded();
}
// x^n for x ≥ 0 and n > 0.
vec3 enclosure_power(vec3 x, float n) {
  float low = enclosure_low(x);
  float high = maximum(enclosure_high(x), 0.0f);
  vec3 y = enclosure_exponential(enclosure_multiply(vec3(n, 0.0f, EPSILON * n), enclosure_logarithm(x)));
  // Near 0 between 0 and the chord to the far end, or where it is steep its value there.
  float top = high > 1.0e-30f ? enclosure_exp(n * log_positive(high)) * (1.0f + 1.0e-6f * (1.0f + n * abs(log_positive(high)))) : 1.0e-30f;
  float slope = n < 1.0f || high < 1.0e-30f ? 0.0f : 0.5f * top / high;
  vec3 near_zero = n < 1.0f ? enclosure_between(0.0f, top) : enclosure_line(x, slope, 0.0f, 0.5f * top);
  return low > 0.125f * high ? y : near_zero;
}

vec3 enclosure_wave(vec3 x, float value, float slope) {
  float radius = enclosure_radius(x);
  float bent = 0.25f * value * radius * radius;
  float e = abs(slope) * x.z + abs(bent) + radius * radius * radius / 6.0f;
  vec3 y = enclosure_rounded(value - bent, slope * x.y, e, 8.0f + 4.0f * (abs(slope * x.y) + e));
  return radius < 1.5f && abs(x.x) < 30000.0f && e < 1.0f ? y : vec3(0.0f, 0.0f, 1.0f);
}
vec3 enclosure_sine(vec3 x) {
  vec2 at = sine_cosine(x.x);
  return enclosure_wave(x, at.x, at.y);
}
vec3 enclosure_cosine(vec3 x) {
  vec2 at = sine_cosine(x.x);
  return enclosure_wave(x, at.y, -at.x);
}

// The angle of (x, y) in (−π, π]: that of the piece's middle, and the arc tangent of what it turns from there.
vec3 enclosure_angle(vec3 y, vec3 x) {
  float length = sqrt(x.x * x.x + y.x * y.x);
  float c = x.x / length;
  float s = y.x / length;
  vec3 along = enclosure_add(enclosure_multiply(vec3(c, 0.0f, EPSILON * 4.0f), x), enclosure_multiply(vec3(s, 0.0f, EPSILON * 4.0f), y));
  vec3 across = enclosure_subtract(enclosure_multiply(vec3(c, 0.0f, EPSILON * 4.0f), y), enclosure_multiply(vec3(s, 0.0f, EPSILON * 4.0f), x));
  vec3 tangent = enclosure_multiply(across, enclosure_reciprocal(along));
  float radius = abs(tangent.x) + enclosure_radius(tangent);
  vec3 turned = vec3(tangent.x + atan_yx(y.x, x.x), tangent.y, tangent.z + radius * radius * radius / 3.0f);
  turned = enclosure_rounded(turned.x, turned.y, turned.z, 16.0f + 4.0f * (abs(turned.x) + abs(turned.y)));
  // Where it may jump from π to −π, or nothing is known.
  bool jumps = enclosure_low(x) <= 0.0f && enclosure_low(y) <= 0.0f && enclosure_high(y) >= 0.0f;
  return !jumps && radius < 1.0f && enclosure_low(along) > 0.0f ? turned : vec3(0.0f, 0.0f, 3.1415930f);
}

// Constant, or one step of the stairs, or the ramp that they are on.
vec3 enclosure_floor(vec3 x) {
  float low = floor(enclosure_low(x));
  float high = floor(enclosure_high(x));
  vec3 ramp = enclosure_line(x, 1.0f, -0.5f, 0.5f);
  return high - low <= 1.0f ? vec3(0.5f * (low + high), 0.0f, 0.5f * (high - low)) : ramp;
}

uint enclosure_less(vec3 x, vec3 y) {
  vec3 d = enclosure_subtract(x, y);
  return enclosure_high(d) < 0.0f ? TRUTH_YES : enclosure_low(d) >= 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint enclosure_less_equal(vec3 x, vec3 y) {
  vec3 d = enclosure_subtract(x, y);
  return enclosure_high(d) <= 0.0f ? TRUTH_YES : enclosure_low(d) > 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint enclosure_equal(vec3 x, vec3 y) {
  vec3 d = enclosure_subtract(x, y);
  return enclosure_high(d) < 0.0f || enclosure_low(d) > 0.0f ? TRUTH_NO : TRUTH_EITHER;
}
uint enclosure_both(uint x, uint y) { return (x & y & TRUTH_YES) | ((x | y) & TRUTH_NO); }
uint enclosure_either(uint x, uint y) { return ((x | y) & TRUTH_YES) | (x & y & TRUTH_NO); }
uint enclosure_opposite(uint x) { return x == TRUTH_YES ? TRUTH_NO : x == TRUTH_NO ? TRUTH_YES : TRUTH_EITHER; }

// Around both where the condition is not certain.
vec3 enclosure_choose(uint condition, vec3 x, vec3 y) {
  float apart = 0.5f * (abs(x.x - y.x) + abs(x.y - y.y));
  vec3 around = enclosure_rounded(0.5f * (x.x + y.x), 0.5f * (x.y + y.y), apart + maximum(x.z, y.z),
                                  4.0f * (abs(x.x) + abs(x.y) + abs(y.x) + abs(y.y)));
  return condition == TRUTH_YES ? x : condition == TRUTH_NO ? y : around;
}

SHADER_END
#endif
