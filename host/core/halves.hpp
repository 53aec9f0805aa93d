// Two halves of a pixel's samples, whose difference shows the noise.
#pragma once

#include <bit>
#include <cstdint>

namespace eyeray::engine {

// Evenly spread samples complete each other. So the halves of a few neighbouring samples differ far more than
// their mean is wrong. Therefore each half has long stretches: of the samples from 2^s to 2^(s + 1), one half
// gets the lower numbers, and the other one the upper numbers. If s is odd, the lower ones are in the first
// half. Sample 0 is in the first half, and sample 1 in the second.
//
// The number of the first `samples` that are in the first half. It is samples/2 if `samples` is a power of
// two above 1, and from a third to two thirds of them if there are 2 or more.
constexpr uint64_t first_half_of(uint64_t samples) {
  if (samples < 2) return samples;
  const uint64_t power = std::bit_floor(samples), stretch = power / 2, rest = samples - power;
  const bool odd = std::countr_zero(power) % 2 == 1;
  const uint64_t lower = rest < stretch ? rest : stretch;
  return stretch + (odd ? lower : rest - lower);
}

constexpr bool in_first_half(uint64_t sample) {
  return first_half_of(sample + 1) > first_half_of(sample);
}

}  // namespace eyeray::engine
