// Correctly rounded division and square root, on devices whose own are not: Vulkan allows 2.5 units in the last place for a quotient, and more for a
// root. The device's result is the first approximation of an integer quotient or root. Its remainder, exact modulo 2^32, corrects it, and then
// decides how the result is rounded. Muller et al.: Handbook of Floating-Point Arithmetic, chapters 4 and 8.
// host/gpu/called_arithmetic.hpp has kernels call these functions.
#ifndef EXACT_GLSL
#define EXACT_GLSL
#include "language.h"

SHADER_BEGIN

// The device's own operations, which tests of the C++ side replace.
#ifndef DEVICE_QUOTIENT
#define DEVICE_QUOTIENT(a, b) ((a) / (b))
#define DEVICE_ROOT(a) sqrt(a)
#endif

// The bits of a positive float as a significand and an exponent: significand · 2^(exponent − 150), 2^23 ≤ significand < 2^24. Zero, infinities and NaN
// have some.
struct ExactParts {
  uint significand;
  int exponent;
};
ExactParts exact_parts(uint bits) {
  bool normal = bits >= 0x00800000u;
  uint scaled = floatBitsToUint(float(int(bits)));  // a subnormal number times 2^149
  scaled = normal ? bits : scaled;
  ExactParts parts;
  parts.significand = (scaled & 0x007fffffu) | 0x00800000u;
  parts.exponent = int(scaled >> 23u) - (normal ? 0 : 149);
  return parts;
}

// The significand of a result from 1 to 2, if it is only about so large.
uint exact_significand(float result) { return floatBitsToUint(result < 1.0f ? 1.0f : result) - 0x3f000000u; }

float exact_quotient(const float a, const float b) {
  uint sign = (floatBitsToUint(a) ^ floatBitsToUint(b)) & 0x80000000u;
  uint x = floatBitsToUint(a) & 0x7fffffffu;
  uint y = floatBitsToUint(b) & 0x7fffffffu;
  ExactParts m = exact_parts(x);
  ExactParts n = exact_parts(y);
  uint less = uint(m.significand < n.significand);
  uint dividend = m.significand << less;

  // q is the nearest integer to dividend / divisor · 2^23, which is never in the middle between two, and twice the remainder shows it. The device's
  // result is wrong by 2 at most.
  int divisor = int(n.significand);
  uint q = exact_significand(DEVICE_QUOTIENT(float(int(dividend)), float(divisor)));
  int rest = int((dividend << 24u) - q * (n.significand << 1u));
  int steps = int(rest > divisor) + int(rest > 3 * divisor) - int(rest < -divisor) - int(rest < -3 * divisor);
  q = q + uint(steps);
  rest = rest - steps * (2 * divisor);

  // A subnormal result has fewer digits: the quotient's, with one for all that follow, are rounded to nearest even.
  int exponent = m.exponent - n.exponent + 127 - int(less);
  uint digits = q + q + uint(rest > 0) - uint(rest < 0);
  int dropped = 2 - (exponent < -24 ? -24 : exponent);
  uint shift = uint(exponent > 0 ? 2 : dropped);
  uint subnormal = (digits + (1u << (shift - 1u)) - 1u + ((digits >> shift) & 1u)) >> shift;
  uint normal = (uint(exponent) << 23u) + (q - 0x00800000u);
  uint bits = exponent > 0 ? normal : subnormal;
  bits = (exponent > 254 ? 0x7f800000u : bits) | sign;

  // Quotients of zeros, infinities and NaN are products with the reciprocal.
  uint special = uint(x - 1u >= 0x7f7fffffu) | uint(y - 1u >= 0x7f7fffffu);
  uint inverse = y > 0x7f800000u ? y : 0x3f800000u;
  inverse = y == 0x7f800000u ? 0u : inverse;
  inverse = y == 0u ? 0x7f800000u : inverse;
  uint product = floatBitsToUint(uintBitsToFloat(x) * uintBitsToFloat(inverse)) | sign;
  return uintBitsToFloat(special != 0u ? product : bits);
}

float exact_root(const float a) {
  uint x = floatBitsToUint(a);
  ExactParts m = exact_parts(x & 0x7fffffffu);
  int odd = (m.exponent + 1) & 1;
  uint radicand = m.significand << uint(odd);

  // q is the nearest integer to 2^23 √(radicand / 2^23), which is never in the middle between two: the square of an odd number is odd.
  uint q = exact_significand(DEVICE_ROOT(float(int(radicand)) * 1.1920929e-7f));
  int rest = int((radicand << 23u) - q * q);
  int steps = int(floor(float(rest) * DEVICE_QUOTIENT(0.5f, float(int(q))) + 0.5f));
  rest = rest - steps * (2 * int(q) + steps);
  q = q + uint(steps);
  q = q + uint(rest > int(q)) - uint(rest <= -int(q));

  uint bits = (uint((m.exponent - odd + 127) >> 1) << 23u) + (q - 0x00800000u);
  // Zeros and infinity are their own roots. Other numbers with a sign, and NaN, have none.
  bits = x > 0x7f800000u ? 0xffc00000u : bits;
  return uintBitsToFloat((x & 0x7fffffffu) == 0u ? x : x == 0x7f800000u ? x : bits);
}

SHADER_END
#endif
