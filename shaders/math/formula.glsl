// GLSL's built-in functions for formulas that users write (docs/implicit-surfaces.md), of one number each, `sin` as `fn_sin`: in the operations of
// math/math.glsl alone, so that GPU and twin agree to the last bit. Absolute or relative errors, whichever is larger, are some 1e-7 unless stated otherwise.
#ifndef FORMULA_GLSL
#define FORMULA_GLSL
#include "math/math.glsl"

SHADER_BEGIN

#define NOT_A_NUMBER uintBitsToFloat(0x7fc00000u)
#define INFINITE uintBitsToFloat(0x7f800000u)

// Iterations that a formula's loops may take in one call, longer ones counting more; none goes on after that (docs/implicit-surfaces.md).
#define FORMULA_ITERATIONS 10000u

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
// Written out: glslang divides constants in double precision.
float fn_radians(float x) { return x * 0.0174532925f; }
float fn_degrees(float x) { return x * 57.2957795f; }

// The sine of `quarters` quarter turns and x, up to |x| of some ten thousand; for larger x some number within [−1, 1]. Cody and Waite's
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
// For x < 0, which GLSL leaves open, defined as in C: for whole y alone. The relative error grows with |y ln x|.
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

// More arguments.
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

// Whole numbers, those of ints in two's complement: nothing that formulas do with them is undefined (host/formula/ir.hpp). Divisors are made harmless
// before any division: processors trap.
uint whole_divide(uint x, uint y) {
  bool odd = y == 0u || y == 0xffffffffu;
  uint quotient = uint(int(x) / int(odd ? 1u : y));
  return y == 0u ? 0u : odd ? 0u - x : quotient;
}
uint natural_divide(uint x, uint y) {
  uint quotient = x / (y == 0u ? 1u : y);
  return y == 0u ? 0u : quotient;
}
uint whole_remainder(uint x, uint y) { return y == 0u ? 0u : x - whole_divide(x, y) * y; }
uint natural_remainder(uint x, uint y) { return y == 0u ? 0u : x - natural_divide(x, y) * y; }
// The remainder with the sign of y.
uint whole_modulo(uint x, uint y) {
  uint rest = whole_remainder(x, y);
  return rest != 0u && int(rest ^ y) < 0 ? rest + y : rest;
}
uint whole_of(float x) { return x >= -2147483648.0f && x < 2147483648.0f ? uint(int(x)) : 0x80000000u; }
uint natural_of(float x) { return x >= 0.0f && x < 4294967296.0f ? uint(x) : 0u; }
uint clamped_index(uint i, uint count) { return int(i) < 0 ? 0u : i < count ? i : count - 1u; }

SHADER_END
#endif
