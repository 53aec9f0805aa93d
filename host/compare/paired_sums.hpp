// Tests whether the difference between two pictures of the same random numbers may be chance, by sums over
// tiles and over the whole picture.
#pragma once

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

// The sum of one channel's differences over a tile, or over the whole picture.
struct PairedSum {
  Rect tile;
  int channel = 0;
  double share = 0;    // |Σ(value − reference)| / Σ|reference|
  double allowed = 0;  // the limit of `share`
  double excess() const { return share == 0 ? 0 : share / allowed; }
};

inline constexpr int paired_tile = 8;  // pixels
// The share of Σ|reference| that rounding may add up to. The rays that leave a surface near an area light may
// all start nearer to it, or all farther away, by 24 ε of the eye's distance (docs/numerics.md).
inline constexpr double paired_rounding = 5e-5;
inline constexpr double paired_false_alarms = 1e-3;  // at most, for all sums of a picture together

// The sum that is farthest beyond its limit, or nearest to it. The limit is the share for rounding plus
// √(2 ln(2 n / a)) √(m Σ(value − reference)²), for n sums and the rate of false alarms a. It holds for
// differences that are symmetric around zero, whatever their distribution (Hoeffding 1963, on the signs
// alone), if at most m of them have one cause and so one sign (Cauchy and Schwarz). This m is 1, unless
// samples of the same number share everything within `shared` of the points that their pixels show, as
// photons do. Then m is the largest number of the sum's pixels whose points lie within `shared` of one
// pixel's point.
PairedSum worst_paired_sum(const Frame& value, const Frame& reference, double shared = 0);

}  // namespace eyeray::engine::compare
