// Finds values that are wrong by themselves, without any comparison. The raw floats are checked before
// anything else.
#pragma once

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

struct Soundness {
  int64_t nan = 0;       // values that are not a number
  int64_t infinite = 0;  // infinite colours, and infinite values of first hits that hit a surface
  int64_t negative = 0;  // colours below 0
  uint64_t flagged_pixels = 0;
  uint32_t flags = 0;
  Pixel first;  // the first pixel, row by row, with any of nan, infinite and negative

  bool ok() const { return nan == 0 && infinite == 0 && negative == 0 && flagged_pixels == 0 && flags == 0; }
};

Soundness inspect(const image::Image& image);
// Checks colours, first hits, counts and flags; `first` is a pixel of the whole picture.
Soundness inspect(const Frame& frame);

// "3 NaN, 1 negative (first at 12,7)", or "" when ok.
std::string describe(const Soundness& soundness);

}  // namespace eyeray::engine::compare
