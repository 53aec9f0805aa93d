// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range
// Images", Eurographics 2021): the greatest LDR-FLIP over the exposures at which the reference shows
// something.
#pragma once

#include <optional>
#include <vector>

#include "host/compare/flip.hpp"

namespace eyeray::engine::compare {

// Exposures in stops. At `start`, the reference's greatest luminance is shown at 0.85 of white; at `stop`,
// its median luminance is.
struct Exposures {
  double start = 0;
  double stop = 0;
  int count = 2;  // evenly spaced: as many as stops between them, rounded up, but at least 2

  double at(int index) const { return start + index * (stop - start) / (count - 1); }
};

// The exposures for a reference; both are 0 if it is black. If the median luminance is 0, the median of the
// luminances above 0 replaces it: the paper leaves this case open.
Exposures exposures_of(const image::Image& reference);

// The linear colours that a display shows at an exposure: tone mapped (by Narkowicz's fit of ACES), linear,
// in [0, 1]. Negative colours count as black.
image::Image exposed(const image::Image& image, double exposure);

struct HdrFlip {
  Exposures exposures;
  Flip flip;
  std::vector<float> map;       // each pixel's greatest error, row by row …
  std::vector<float> exposure;  // … and the first exposure at which it is found, in stops
};

// HDR-FLIP of two linear 1- or 3-channel pictures of one size; `b` is the reference. Empty if a value is not
// finite.
std::optional<HdrFlip> hdr_flip(const image::Image& a, const image::Image& b);

}  // namespace eyeray::engine::compare
