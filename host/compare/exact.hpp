// Gate A: two executors of the same float32 source agree to the last bit.
#pragma once

#include "host/compare/frame.hpp"
#include "host/compare/seam.hpp"

namespace eyeray::engine::compare {

struct ExactComparison {
  std::string incomparable;      // why nothing was compared; empty when everything was
  int64_t pixels = 0;            // compared
  int64_t different_pixels = 0;  // with any differing bit in colour, first hit, hit count or a sample
  int64_t different_colors = 0;  // pixels with another colour
  int64_t different_first_hits = 0;
  int64_t different_ids = 0;  // pixels with another primitive, material or trail: no ULP bound forgives these
  int64_t max_ulp = 0;        // the largest distance of two values, in units in the last place of float32
  uint64_t rays = 0, other_rays = 0;
  WorstPixel worst;  // the pixel with the largest distance; x = −1 when there is none

  // True if every bit agrees. With `ulp` > 0, for hardware whose sqrt or division is looser: true if every
  // value is that near and every id agrees.
  bool passes(int64_t ulp) const;
};

ExactComparison compare_exactly(const Frame& value, const Frame& other);

// The number of float32 values from a to b; the greatest int64 when just one of them is NaN.
int64_t ulp_distance(float a, float b);

}  // namespace eyeray::engine::compare
