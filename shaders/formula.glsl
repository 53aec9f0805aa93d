// GLSL's built-in functions for formulas that users write (docs/implicit-surfaces.md), `sin` as `fn_sin`: in the operations of math.glsl alone,
// so that GPU and twin agree to the last bit. Absolute or relative errors, whichever is larger, are of some 1e-7 where nothing else is said.
#ifndef FORMULA_GLSL
#define FORMULA_GLSL
#include "math.glsl"

SHADER_BEGIN

#define NOT_A_NUMBER uintBitsToFloat(0x7fc00000u)
#define INFINITE uintBitsToFloat(0x7f800000u)

// Turns that the loops of a formula may make in one call; none of them goes on after that (docs/implicit-surfaces.md).
#define FORMULA_TURNS 10000u

// One argument.
float fn_abs(float x) { return abs(x); }
float fn_sign(float x) { return x > 0.0f ? 1.0f : x < 0.0f ? -1.0f : 0.0f; }
float fn_floor(float x) { return floor(x); }
float fn_ceil(float x) { return -floor(-x); }
float fn_trunc(float x) { return x < 0.0f ? -floor(-x) : floor(x); }
float fn_round(float x) { return floor(x + 0.5f); }
float fn_fract(float x) { return x - floor(x); }
float fn_sqrt(float x) { return sqrt(x); }
float fn_inversesqrt(float x) { return 1.0f / sqrt(x); }
float fn_radians(float x) { return x * (PI / 180.0f); }
float fn_degrees(float x) { return x * (180.0f / PI); }

// The sine of `quarters` quarter turns and x, up to |x| of some ten thousand; what lies beyond is no angle but within [−1, 1]. Cody and Waite's
// reduction, polynomials of degree 7 and 8.
float sine_of(float x, float quarters) {
  float k = floor(x * 0.636619772f + 0.5f);
  float r = ((x - k * 1.5703125f) - k * 4.837512969970703e-4f) - k * 7.549789954891882e-8f;
  r = r > 0.8f ? 0.8f : r < -0.8f ? -0.8f : r;
  float turn = k + quarters;
  turn = turn - 4.0f * floor(turn * 0.25f);
  float z = r * r;
  float sine = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
  float cosine = ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * (z * z) - 0.5f * z + 1.0f;
  float y = turn == 1.0f || turn == 3.0f ? cosine : sine;
  return turn >= 2.0f ? -y : y;
}
float fn_sin(float x) { return sine_of(x, 0.0f); }
float fn_cos(float x) { return sine_of(x, 1.0f); }
float fn_tan(float x) { return fn_sin(x) / fn_cos(x); }
float fn_asin(float x) { return atan_yx(x, sqrt((1.0f - x) * (1.0f + x))); }
float fn_acos(float x) { return atan_yx(sqrt((1.0f - x) * (1.0f + x)), x); }
float fn_atan(float x) { return atan_yx(x, 1.0f); }
float fn_atan(float y, float x) { return atan_yx(y, x); }

float fn_exp(float x) {
  float y = exp_negative(-abs(x));
  return x <= 0.0f ? y : x > 88.0f ? INFINITE : 1.0f / y;
}
float fn_log(float x) {
  bool small = x < 1.17549435e-38f;
  float y = log_positive(maximum(small ? x * 16777216.0f : x, 1.0e-37f)) - (small ? 16.6355323f : 0.0f);
  return x > 0.0f ? (x < INFINITE ? y : x) : x == 0.0f ? -INFINITE : NOT_A_NUMBER;
}
float fn_exp2(float x) { return fn_exp(x * 0.693147181f); }
float fn_log2(float x) { return fn_log(x) * 1.44269504f; }
// Of x < 0, which GLSL leaves open, for whole y alone, as in C. The relative error grows with |y ln x|.
float fn_pow(float x, float y) {
  float power = x == 0.0f ? (y > 0.0f ? 0.0f : y == 0.0f ? 1.0f : INFINITE) : fn_exp(y * fn_log(abs(x)));
  bool odd = floor(0.5f * y) != 0.5f * y;
  return x >= 0.0f ? power : floor(y) != y ? NOT_A_NUMBER : odd ? -power : power;
}
float fn_sinh(float x) {
  float z = x * x;
  float e = fn_exp(abs(x));
  float y = 0.5f * (e - 1.0f / e);
  return abs(x) < 0.5f ? ((z * 1.98412698e-4f + 8.33333333e-3f) * z + 0.166666667f) * z * x + x : x < 0.0f ? -y : y;
}
float fn_cosh(float x) {
  float e = fn_exp(abs(x));
  return 0.5f * (e + 1.0f / e);
}
float fn_tanh(float x) {
  float e = exp_negative(-2.0f * abs(x));
  float y = (1.0f - e) / (1.0f + e);
  return abs(x) < 0.5f ? fn_sinh(x) / fn_cosh(x) : x < 0.0f ? -y : y;
}

// More of them.
float fn_min(float x, float y) { return minimum(x, y); }
float fn_max(float x, float y) { return maximum(x, y); }
float fn_mod(float x, float y) { return x - y * floor(x / y); }
float fn_step(float edge, float x) { return x < edge ? 0.0f : 1.0f; }
float fn_clamp(float x, float low, float high) { return minimum(maximum(x, low), high); }
float fn_mix(float x, float y, float share) { return x * (1.0f - share) + y * share; }
float fn_smoothstep(float low, float high, float x) {
  float t = fn_clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

// The same for each component.
#define EACH_OF_ONE(name)                                                                    \
  vec2 name(vec2 v) { return vec2(name(v.x), name(v.y)); }                                   \
  vec3 name(vec3 v) { return vec3(name(v.x), name(v.y), name(v.z)); }                        \
  vec4 name(vec4 v) { return vec4(name(v.x), name(v.y), name(v.z), name(v.w)); }
#define EACH_OF_TWO(name)                                                                    \
  vec2 name(vec2 a, vec2 b) { return vec2(name(a.x, b.x), name(a.y, b.y)); }                 \
  vec3 name(vec3 a, vec3 b) { return vec3(name(a.x, b.x), name(a.y, b.y), name(a.z, b.z)); } \
  vec4 name(vec4 a, vec4 b) { return vec4(name(a.x, b.x), name(a.y, b.y), name(a.z, b.z), name(a.w, b.w)); }
#define EACH_AND_A_NUMBER(name)                                                              \
  vec2 name(vec2 a, float b) { return name(a, vec2(b, b)); }                                 \
  vec3 name(vec3 a, float b) { return name(a, vec3(b, b, b)); }                              \
  vec4 name(vec4 a, float b) { return name(a, vec4(b, b, b, b)); }
#define EACH_OF_THREE(name)                                                                  \
  vec2 name(vec2 a, vec2 b, vec2 c) { return vec2(name(a.x, b.x, c.x), name(a.y, b.y, c.y)); } \
  vec3 name(vec3 a, vec3 b, vec3 c) { return vec3(name(a.x, b.x, c.x), name(a.y, b.y, c.y), name(a.z, b.z, c.z)); } \
  vec4 name(vec4 a, vec4 b, vec4 c) {                                                        \
    return vec4(name(a.x, b.x, c.x), name(a.y, b.y, c.y), name(a.z, b.z, c.z), name(a.w, b.w, c.w)); \
  }
EACH_OF_ONE(fn_abs)
EACH_OF_ONE(fn_sign)
EACH_OF_ONE(fn_floor)
EACH_OF_ONE(fn_ceil)
EACH_OF_ONE(fn_trunc)
EACH_OF_ONE(fn_round)
EACH_OF_ONE(fn_fract)
EACH_OF_ONE(fn_sqrt)
EACH_OF_ONE(fn_inversesqrt)
EACH_OF_ONE(fn_radians)
EACH_OF_ONE(fn_degrees)
EACH_OF_ONE(fn_sin)
EACH_OF_ONE(fn_cos)
EACH_OF_ONE(fn_tan)
EACH_OF_ONE(fn_asin)
EACH_OF_ONE(fn_acos)
EACH_OF_ONE(fn_atan)
EACH_OF_TWO(fn_atan)
EACH_OF_ONE(fn_exp)
EACH_OF_ONE(fn_log)
EACH_OF_ONE(fn_exp2)
EACH_OF_ONE(fn_log2)
EACH_OF_TWO(fn_pow)
EACH_OF_ONE(fn_sinh)
EACH_OF_ONE(fn_cosh)
EACH_OF_ONE(fn_tanh)
EACH_OF_TWO(fn_min)
EACH_AND_A_NUMBER(fn_min)
EACH_OF_TWO(fn_max)
EACH_AND_A_NUMBER(fn_max)
EACH_OF_TWO(fn_mod)
EACH_AND_A_NUMBER(fn_mod)
EACH_OF_TWO(fn_step)
vec2 fn_step(float edge, vec2 v) { return fn_step(vec2(edge, edge), v); }
vec3 fn_step(float edge, vec3 v) { return fn_step(vec3(edge, edge, edge), v); }
vec4 fn_step(float edge, vec4 v) { return fn_step(vec4(edge, edge, edge, edge), v); }
EACH_OF_THREE(fn_clamp)
vec2 fn_clamp(vec2 v, float low, float high) { return fn_min(fn_max(v, low), high); }
vec3 fn_clamp(vec3 v, float low, float high) { return fn_min(fn_max(v, low), high); }
vec4 fn_clamp(vec4 v, float low, float high) { return fn_min(fn_max(v, low), high); }
EACH_OF_THREE(fn_mix)
vec2 fn_mix(vec2 a, vec2 b, float share) { return fn_mix(a, b, vec2(share, share)); }
vec3 fn_mix(vec3 a, vec3 b, float share) { return fn_mix(a, b, vec3(share, share, share)); }
vec4 fn_mix(vec4 a, vec4 b, float share) { return fn_mix(a, b, vec4(share, share, share, share)); }
EACH_OF_THREE(fn_smoothstep)
vec2 fn_smoothstep(float low, float high, vec2 v) { return fn_smoothstep(vec2(low, low), vec2(high, high), v); }
vec3 fn_smoothstep(float low, float high, vec3 v) { return fn_smoothstep(vec3(low, low, low), vec3(high, high, high), v); }
vec4 fn_smoothstep(float low, float high, vec4 v) {
  return fn_smoothstep(vec4(low, low, low, low), vec4(high, high, high, high), v);
}

// Vectors as such.
float fn_dot(float a, float b) { return a * b; }
float fn_dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
float fn_dot(vec3 a, vec3 b) { return dot3(a, b); }
float fn_dot(vec4 a, vec4 b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
float fn_length(float x) { return abs(x); }
float fn_length(vec2 v) { return sqrt(fn_dot(v, v)); }
float fn_length(vec3 v) { return sqrt(fn_dot(v, v)); }
float fn_length(vec4 v) { return sqrt(fn_dot(v, v)); }
float fn_distance(float a, float b) { return abs(a - b); }
float fn_distance(vec2 a, vec2 b) { return fn_length(a - b); }
float fn_distance(vec3 a, vec3 b) { return fn_length(a - b); }
float fn_distance(vec4 a, vec4 b) { return fn_length(a - b); }
vec2 fn_normalize(vec2 v) { return v / fn_length(v); }
vec3 fn_normalize(vec3 v) { return v / fn_length(v); }
vec4 fn_normalize(vec4 v) { return v / fn_length(v); }
vec3 fn_cross(vec3 a, vec3 b) { return cross3(a, b); }
vec2 fn_reflect(vec2 v, vec2 n) { return v - n * (2.0f * fn_dot(n, v)); }
vec3 fn_reflect(vec3 v, vec3 n) { return v - n * (2.0f * fn_dot(n, v)); }

SHADER_END
#endif
