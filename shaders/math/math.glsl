// Functions that GLSL leaves to the driver (dot, cross, normalize, exp, pow, atan, min of NaN) are written out, so that a GPU and the twin
// agree to the last bit. Only + - * / sqrt, floor, abs, comparisons and integers are taken from the language.
#ifndef MATH_GLSL
#define MATH_GLSL
#include "language.h"
#include "math/device.glsl"
#include "records.h"

SHADER_BEGIN

#define PI 3.14159265358979f
#define EPSILON 5.9604645e-8f  // 2^-24, half an ulp of 1

float minimum(float x, float y) { return y < x ? y : x; }
float maximum(float x, float y) { return x < y ? y : x; }
// x, with 0 for −0. llvmpipe takes 0·x as 0 where a factor is a constant, whatever the sign of x. Values that leave a kernel go
// through here, so that the sign of a zero is the same everywhere.
float positive_zero(float x) { return x == 0.0f ? 0.0f : x; }
// a / b for b > 0 and a < 2^24. A CPU driver divides integers lane by lane, floats all at once; they are off by one at most, on any device.
uint quotient(uint a, uint b) {
  uint q = uint(float(a) / float(b));
  q = q * b > a ? q - 1u : q;
  return a - q * b >= b ? q + 1u : q;
}
// The number of the lowest bit that x ≠ 0 has, by the exponent of a float.
uint lowest_bit(uint x) { return ((floatBitsToUint(float(int(x & (~x + 1u)))) >> 23u) & 255u) - 127u; }
vec4 bits_to_floats(uvec4 v) {
  return vec4(uintBitsToFloat(v.x), uintBitsToFloat(v.y), uintBitsToFloat(v.z), uintBitsToFloat(v.w));
}
vec3 positive_zeros(vec3 v) { return vec3(positive_zero(v.x), positive_zero(v.y), positive_zero(v.z)); }
float max_component(vec3 v) { return maximum(v.x, maximum(v.y, v.z)); }
vec3 abs3(vec3 v) { return vec3(abs(v.x), abs(v.y), abs(v.z)); }

float dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
vec3 cross3(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
vec3 normalize3(vec3 v) { return v / sqrt(dot3(v, v)); }
// l mirrored at the unit normal n; both point away from the surface.
vec3 mirror3(vec3 l, vec3 n) { return n * (2.0f * dot3(n, l)) - l; }

// e^x for x ≤ 0, within 2 ulp; 0 below −87. Cody and Waite's reduction, a polynomial of degree 6.
float exp_negative(float x) {
  float k = floor(maximum(x, -87.0f) * 1.44269504f + 0.5f);
  float r = (maximum(x, -87.0f) - k * 0.693359375f) + k * 2.12194440e-4f;
  float p = 1.9875691500e-4f;
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  p = (p * (r * r) + r) + 1.0f;
  // NaN passes through by p, and does not enter the exponent.
  float y = p * uintBitsToFloat(uint(int(maximum(-127.0f, k)) + 127) << 23u);
  return x < -87.0f ? 0.0f : y;
}

// ln(x) for normal x > 0, within 2 ulp away from 1; a polynomial of degree 8 on [√½, √2].
float log_positive(float x) {
  uint bits = floatBitsToUint(x);
  float exponent = float(int(bits >> 23u) - 126);
  float m = uintBitsToFloat((bits & 0x007fffffu) | 0x3f000000u);
  bool low = m < 0.707106781f;
  exponent = low ? exponent - 1.0f : exponent;
  float r = low ? (m + m) - 1.0f : m - 1.0f;
  float z = r * r;
  float p = 7.0376836292e-2f;
  p = p * r - 1.1514610310e-1f;
  p = p * r + 1.1676998740e-1f;
  p = p * r - 1.2420140846e-1f;
  p = p * r + 1.4249322787e-1f;
  p = p * r - 1.6668057665e-1f;
  p = p * r + 2.0000714765e-1f;
  p = p * r - 2.4999993993e-1f;
  p = p * r + 3.3333331174e-1f;
  float y = p * (r * z) + exponent * -2.12194440e-4f - 0.5f * z;
  return (r + y) + exponent * 0.693359375f;
}

// (1 − e)^n for 0 ≤ e ≤ 1. Taking e instead of 1 − e keeps highlights of high exponents exact where e is small. The error
// grows with √n, not with n. ln(1 − e) is Kahan's: the rounding of 1 − e is divided out again.
float power_of_complement(float e, float n) {
  float u = 1.0f - e;
  float log_u = u == 1.0f ? -e : log_positive(maximum(u, 1.0e-30f)) * (e / (1.0f - u));
  return u <= 0.0f ? 0.0f : exp_negative(n * log_u);
}

// The angle of (x, y) in (−π, π], absolute error 3e-7; 0 at the origin.
float atan_yx(float y, float x) {
  float ax = abs(x);
  float ay = abs(y);
  float high = maximum(ax, ay);
  float t = minimum(ax, ay) / (high == 0.0f ? 1.0f : high);
  bool steep = t > 0.414213562f;
  float s = steep ? (t - 1.0f) / (t + 1.0f) : t;
  float z = s * s;
  float p = 8.05374449538e-2f;
  p = p * z - 1.38776856032e-1f;
  p = p * z + 1.99777106478e-1f;
  p = p * z - 3.33329491539e-1f;
  float angle = (p * z * s + s) + (steep ? 0.785398163f : 0.0f);
  angle = ay > ax ? 1.57079633f - angle : angle;
  angle = x < 0.0f ? PI - angle : angle;
  return y < 0.0f ? -angle : angle;
}

SHADER_END
#endif
