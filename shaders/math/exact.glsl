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

// A float of these bits, positive and finite, is significand · 2^(exponent − 150), 2^23 ≤ significand < 2^24.
struct ExactParts {
  uint significand;
  int exponent;
};
ExactParts exact_parts(uint bits) {
  bool normal = bits >= 0x00800000u;
  int top = int(floatBitsToUint(float(int(bits))) >> 23u) - 127;  // the position of the highest bit
  ExactParts parts;
  parts.significand = normal ? (bits & 0x007fffffu) | 0x00800000u : bits << uint(23 - top);
  parts.exponent = normal ? int(bits >> 23u) : top - 22;
  return parts;
}

// The significand as a float, from 1 to below 2.
float exact_scaled(ExactParts parts) { return uintBitsToFloat(0x3f800000u | (parts.significand & 0x007fffffu)); }

// The bits of q · 2^(exponent − 152), 2^25 ≤ q < 2^26, rounded to nearest even. `rest`: q is less than the true value, by less than 1.
uint exact_rounded(uint q, bool rest, int exponent) {
  if (exponent >= 255) return 0x7f800000u;
  if (exponent < -26) return 0u;
  uint shift = exponent > 0 ? 2u : uint(3 - exponent);
  uint kept = q >> shift;
  uint low = q & ((1u << shift) - 1u);
  uint middle = 1u << (shift - 1u);
  bool up = low > middle || (low == middle && (rest || (kept & 1u) == 1u));
  return (exponent > 0 ? (uint(exponent) << 23u) + (kept - 0x00800000u) : kept) + (up ? 1u : 0u);
}

float exact_quotient(const float a, const float b) {
  uint sign = (floatBitsToUint(a) ^ floatBitsToUint(b)) & 0x80000000u;
  uint x = floatBitsToUint(a) & 0x7fffffffu;
  uint y = floatBitsToUint(b) & 0x7fffffffu;
  if (x == 0u || y == 0u || x >= 0x7f800000u || y >= 0x7f800000u) {
    bool none = x > 0x7f800000u || y > 0x7f800000u || (x == y && (x == 0u || x == 0x7f800000u));
    bool infinite = x == 0x7f800000u || y == 0u;
    return uintBitsToFloat(none ? 0xffc00000u : infinite ? sign | 0x7f800000u : sign);
  }
  ExactParts m = exact_parts(x);
  ExactParts n = exact_parts(y);

  // q = ⌊2^25 m / n⌋, and its remainder.
  uint q = uint(DEVICE_QUOTIENT(exact_scaled(m), exact_scaled(n)) * 33554432.0f);
  int divisor = int(n.significand);
  int rest = int((m.significand << 25u) - q * n.significand);
  int steps = int(floor(float(rest) * DEVICE_QUOTIENT(1.0f, float(divisor))));
  q = q + uint(steps);
  rest = rest - steps * divisor;
  int more = rest < 0 ? -1 : rest >= divisor ? 1 : 0;
  q = q + uint(more);
  rest = rest - more * divisor;

  int exponent = m.exponent - n.exponent + 127;
  if (q < 0x02000000u) {
    rest = rest + rest;
    q = q + q + (rest >= divisor ? 1u : 0u);
    rest = rest >= divisor ? rest - divisor : rest;
    exponent = exponent - 1;
  }
  return uintBitsToFloat(sign | exact_rounded(q, rest != 0, exponent));
}

float exact_root(const float a) {
  uint x = floatBitsToUint(a);
  if ((x & 0x7fffffffu) == 0u || x == 0x7f800000u) return a;
  if (x > 0x7f800000u) return uintBitsToFloat(0xffc00000u);
  ExactParts m = exact_parts(x);
  bool odd = ((m.exponent - 127) & 1) != 0;
  int exponent = m.exponent - 127 - (odd ? 1 : 0);
  uint radicand = odd ? m.significand << 1u : m.significand;

  // q = ⌊2^24 √(radicand / 2^23)⌋, and the rest of its square. It has one bit more than a float. It is never in the middle between two: the square of an
  // odd number is odd.
  uint q = uint(DEVICE_ROOT(exact_scaled(m) * (odd ? 2.0f : 1.0f)) * 16777216.0f);
  int rest = int((radicand << 25u) - q * q);
  int steps = int(floor(float(rest) * DEVICE_QUOTIENT(0.5f, float(int(q)))));
  rest = rest - steps * (2 * int(q) + steps);
  q = q + uint(steps);
  if (rest < 0) {
    q = q - 1u;
    rest = rest + 2 * int(q) + 1;
  }
  q = rest > 2 * int(q) ? q + 1u : q;
  return uintBitsToFloat((uint(exponent / 2 + 127) << 23u) + ((q >> 1u) - 0x00800000u) + (q & 1u));
}

SHADER_END
#endif
