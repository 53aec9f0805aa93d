// Whether what differs between two pictures of the same random numbers is chance: a test of sums, over tiles
// and over all.
#pragma once

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

// A sum of differences: of one channel of a tile, or of all.
struct PairedSum {
  Rect tile;
  int channel = 0;
  double share = 0;    // |Σ(value − reference)| / Σ|reference|
  double allowed = 0;  // of it
  double excess() const { return share == 0 ? 0 : share / allowed; }
};

inline constexpr int paired_tile = 8;  // pixels
// What rounding may add up to, of Σ|reference|: what leaves a surface by the lamp leaves it all nearer, or
// farther, by 24 ε of the eye's distance (docs/numerics.md).
inline constexpr double paired_rounding = 5e-5;
inline constexpr double paired_false_alarms = 1e-3;  // of all sums of a picture together, at most

// Of all sums that which is farthest beyond, or nearest to, what is allowed: rounding, and √(2 ln(2 n / a))
// √(m Σ(value − reference)²), n sums, a the false alarms. For differences that are as likely up as down that
// holds whatever else they are (Hoeffding 1963, of the signs alone), if at most m of them have one cause and
// so one sign (Cauchy and Schwarz). m is 1, but where samples of the same number share what lies within
// `shared` of what their pixels show, as photons: then it is how many of a tile, or of all, lie so near to
// one of them.
PairedSum worst_paired_sum(const Frame& value, const Frame& reference, double shared = 0);

}  // namespace eyeray::engine::compare
