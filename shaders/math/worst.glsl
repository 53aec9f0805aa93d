// Division and square root as wrong as a device may compute them, by up to 2 units in the last place either way: for tests of exact.glsl.
#ifndef WORST_GLSL
#define WORST_GLSL
#include "language.h"

SHADER_BEGIN

// A result is wrong by a number that its operands decide. Zeros, infinities, NaN and numbers near them stay.
float worst_of(float result, uint operands) {
  uint bits = floatBitsToUint(result);
  uint exponent = (bits >> 23u) & 255u;
  uint hash = operands * 0x9e3779b1u;
  hash = (hash ^ (hash >> 15u)) * 0x85ebca77u;
  int units = int((hash >> 16u) % 5u) - 2;
  return exponent > 1u && exponent < 254u ? uintBitsToFloat(bits + uint(units)) : result;
}

float worst_quotient(const float a, const float b) { return worst_of(a / b, floatBitsToUint(a) ^ (floatBitsToUint(b) * 3u)); }
float worst_root(const float a) { return worst_of(sqrt(a), floatBitsToUint(a)); }

SHADER_END
#endif
