#include <algorithm>
#include <cmath>

#include "host/emulator/bits.hpp"

namespace eyeray::engine::emulator {

float half_to_float(uint32_t half) {
  const uint32_t sign = half >> 15 & 1u, exponent = half >> 10 & 31u, fraction = half & 1023u;
  if (exponent == 31 && fraction != 0) {
    const uint32_t nan = sign << 31 | 0x7fc00000u | fraction << 13, birth = birth_of(half, 16);
    return std::bit_cast<float>(birth ? with_birth(sign << 31, 32, birth) : nan);
  }
  const float magnitude = exponent == 0    ? std::ldexp(float(fraction), -24)
                          : exponent == 31 ? INFINITY
                                           : std::ldexp(float(fraction + 1024), int(exponent) - 25);
  return sign ? -magnitude : magnitude;
}

uint32_t to_half(double x) {
  const uint32_t sign = std::signbit(x) ? 0x8000u : 0u;
  const double magnitude = std::fabs(x);
  if (std::isnan(x)) {
    const auto high = uint32_t(std::bit_cast<uint64_t>(x) >> 32);
    const uint32_t birth = birth_of(high, 64);
    return birth ? with_birth(sign, 16, birth) : sign | 0x7e00u | (high >> 10 & 1023u);
  }
  if (magnitude >= 65520) return sign | 0x7c00u;
  int exponent = 0;
  std::frexp(magnitude, &exponent);
  const int step = std::max(exponent - 11, -24);
  const auto steps = uint32_t(std::nearbyint(std::ldexp(magnitude, -step)));
  return sign | (steps < 1024 ? steps : uint32_t(step + 24) * 1024u + steps);
}

}  // namespace eyeray::engine::emulator
