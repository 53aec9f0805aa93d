// The difference of two pictures in the usual metrics. They are reported; they are not the gate.
#pragma once

#include <array>
#include <optional>

#include "host/compare/flip.hpp"
#include "host/compare/frame.hpp"
#include "host/compare/hdr_flip.hpp"

namespace eyeray::engine::compare {

// Unless stated otherwise, differences are of linear values, and a pixel's difference is that of its worst
// channel.
struct Metrics {
  double rmse = 0;          // over all channels
  double psnr = 0;          // dB against a peak of 1; infinite for equal pictures
  double relative_mse = 0;  // the mean of (a − b)² / (b + 0.01)², as in pbrt's imgtool
  double p95 = 0;           // 95 % of the pixels differ by no more than this
  double p99 = 0;
  double p999 = 0;
  double max = 0;
  Pixel max_at;
  Vec3 max_a{0.0}, max_b{0.0};  // both colours at max_at
  // The numbers of pixels whose displayed values (sRGB-encoded, clipped to [0, 1]) differ by more than 1, 2,
  // 4, 8, 16 of 255.
  std::array<int64_t, 5> display_over{};
  // The numbers of pixels that differ by less than 1e-7, from each power of ten to the next, and by 1 or
  // more.
  std::array<int64_t, 9> decades{};
  // The mean SSIM of the sRGB-encoded luma, clipped to [0, 1] (Wang et al. 2004: 11 × 11 Gaussian, σ 1.5).
  double ssim = 1;
  Flip flip;
  std::optional<HdrFlip> hdr_flip;  // if requested
};
inline constexpr std::array<int, 5> display_steps = {1, 2, 4, 8, 16};
inline constexpr int first_decade = -7;

// Compares two linear 1- or 3-channel pictures of one size, of at least one pixel. A value that is not finite
// counts as an infinite difference. `hdr`: whether HDR-FLIP is measured, with b the reference; for each of
// its exposures it takes as long as FLIP.
Metrics measure(const image::Image& a, const image::Image& b, bool hdr = false);

// The number of pixels that do not match within `tolerance` · max(1, |b|) in every channel, by the rule of
// verify's gate B.
int64_t count_different(const image::Image& a, const image::Image& b, double tolerance);

// For a false-colour picture: log10 of each pixel's worst |difference|, no less than −8; 1 channel.
image::Image log_difference(const image::Image& a, const image::Image& b);

}  // namespace eyeray::engine::compare
