// How far two pictures are apart, in the numbers that people quote. They are reported; they are not the gate.
#pragma once

#include "host/compare/frame.hpp"

namespace eyeray::compare {

struct Metrics {
  double rmse = 0;  // over all channels
  double psnr = 0;  // dB against a peak of 1; infinite for equal pictures
  double p99 = 0;   // 99 % of the pixels differ by no more than this (in their worst channel)
  double p999 = 0;
  double max = 0;
  Pixel max_at;
  double ssim =
      1;  // mean, on the sRGB-encoded luma clipped to [0, 1] (Wang et al. 2004: 11 × 11 Gaussian, σ 1.5)
  double flip = 0;  // mean LDR-FLIP
};

// Of two 1- or 3-channel linear pictures of one size, at least one pixel. A value that is not finite counts
// as an infinite difference.
Metrics measure(const Image& a, const Image& b);

// The pixels that do not match within `tolerance` · max(1, |b|) in every channel, as verify's gate B has it.
int64_t count_different(const Image& a, const Image& b, double tolerance);

// For a false-colour picture: log10 of each pixel's worst |difference|, no less than −8; 1 channel.
Image log_difference(const Image& a, const Image& b);

}  // namespace eyeray::compare
