// Two halves of a pixel's samples, whose difference shows the noise.
#pragma once

#include <bit>
#include <cstdint>

namespace eyeray::engine {

// Evenly spread samples complete each other, so the halves of a few neighbouring samples differ far more than
// their mean is wrong. Therefore each half has long stretches of samples: of those from 2^s to 2^(s + 1), the
// lower half of the numbers goes to one half of the samples, and the upper half to the other one. The first
// stretch goes to the first half if s is odd. Sample 0 is in the first half, and sample 1 in the second.
//
// The number of the first `samples` that are in the first half: half of them if `samples` is a power of two
// above 1, at most two thirds of them, and at least one third, if there are 2 or more.
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
