// A number with its gradient: (gradient, value). Functions of such numbers give the exact derivative, rounded, of the computation (forward
// differentiation).
#ifndef DUAL_GLSL
#define DUAL_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

vec4 dual_of(vec3 gradient, float value) { return vec4(gradient.x, gradient.y, gradient.z, value); }
// φ(x), its derivative at x being `slope`.
vec4 dual_chain(vec4 x, float slope, float value) { return dual_of(vec3(x) * slope, value); }

vec4 dual_negate(vec4 x) { return dual_of(vec3(0.0f, 0.0f, 0.0f) - vec3(x), -x.w); }
vec4 dual_add(vec4 x, vec4 y) { return dual_of(vec3(x) + vec3(y), x.w + y.w); }
vec4 dual_subtract(vec4 x, vec4 y) { return dual_of(vec3(x) - vec3(y), x.w - y.w); }
vec4 dual_multiply(vec4 x, vec4 y) { return dual_of(vec3(x) * y.w + vec3(y) * x.w, x.w * y.w); }
vec4 dual_scale(vec4 x, float factor) { return dual_chain(x, factor, factor * x.w); }
vec4 dual_square(vec4 x) { return dual_chain(x, 2.0f * x.w, x.w * x.w); }
vec4 dual_reciprocal(vec4 x) {
  float y = 1.0f / x.w;
  return dual_chain(x, -y * y, y);
}
vec4 dual_absolute(vec4 x) { return dual_chain(x, x.w < 0.0f ? -1.0f : 1.0f, abs(x.w)); }
vec4 dual_minimum(vec4 x, vec4 y) { return y.w < x.w ? y : x; }
vec4 dual_maximum(vec4 x, vec4 y) { return x.w < y.w ? y : x; }
// At 0, where it is infinitely steep, it is taken as flat.
vec4 dual_square_root(vec4 x) {
  float y = sqrt(maximum(x.w, 0.0f));
  return dual_chain(x, y > 0.0f ? 0.5f / y : 0.0f, y);
}
float dual_exp(float x) { return x > 0.0f ? 1.0f / exp_negative(-x) : exp_negative(x); }
vec4 dual_exponential(vec4 x) {
  float y = dual_exp(x.w);
  return dual_chain(x, y, y);
}
vec4 dual_logarithm(vec4 x) { return dual_chain(x, 1.0f / x.w, log_positive(maximum(x.w, 1.0e-30f))); }
vec4 dual_power(vec4 x, float n) {
  bool positive = x.w > 1.0e-30f;
  float y = positive ? dual_exp(n * log_positive(maximum(x.w, 1.0e-30f))) : 0.0f;
  return dual_chain(x, positive ? n * y / x.w : 0.0f, y);
}
vec4 dual_sine(vec4 x) {
  vec2 at = sine_cosine(x.w);
  return dual_chain(x, at.y, at.x);
}
vec4 dual_cosine(vec4 x) {
  vec2 at = sine_cosine(x.w);
  return dual_chain(x, -at.x, at.y);
}
vec4 dual_angle(vec4 y, vec4 x) {
  float square = x.w * x.w + y.w * y.w;
  return dual_of((vec3(y) * x.w - vec3(x) * y.w) / square, atan_yx(y.w, x.w));
}
vec4 dual_floor(vec4 x) { return dual_of(vec3(0.0f, 0.0f, 0.0f), floor(x.w)); }

bool dual_less(vec4 x, vec4 y) { return x.w < y.w; }
bool dual_less_equal(vec4 x, vec4 y) { return x.w <= y.w; }
bool dual_equal(vec4 x, vec4 y) { return x.w == y.w; }
bool dual_both(bool x, bool y) { return x && y; }
bool dual_either(bool x, bool y) { return x || y; }
bool dual_opposite(bool x) { return !x; }
vec4 dual_choose(bool condition, vec4 x, vec4 y) { return condition ? x : y; }

SHADER_END
#endif
