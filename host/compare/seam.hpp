// The point where two executors diverge: the first value along the life of a ray that differs.
#pragma once

#include <string>

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

enum class Seam {
  none,
  primitive,
  t,
  position,
  normal,
  geometric_normal,
  uv,
  material,
  color,
  counts,
  trail
};

// A pixel that stands for a comparison in its report: both values, and the seam.
struct WorstPixel {
  Pixel pixel;
  Vec3 value{0.0}, reference{0.0};
  Counts value_counts{0.0}, reference_counts{0.0};
  FirstHit value_hit, reference_hit;
  double excess = 0;  // the largest error, in tolerances (or in ULP)
  Seam seam = Seam::none;
  int sample = -1;  // the pixel's sample with these colours and counts; −1: they are the means of all samples
  std::string parting = {};  // the event at which the sample's paths diverge, in words
};

// For reports: "first hit's t".
const char* name(Seam seam);

}  // namespace eyeray::engine::compare
