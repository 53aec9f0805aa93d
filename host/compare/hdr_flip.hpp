// HDR-FLIP (Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in Rendered High Dynamic Range
// Images", Eurographics 2021): the greatest LDR-FLIP over the exposures at which the reference shows
// something.
#pragma once

#include <optional>
#include <vector>

#include "host/compare/flip.hpp"

namespace eyeray::engine::compare {

// In stops: from where the brightest of the reference comes out at 0.85 of white, to where its median does.
struct Exposures {
  double start = 0;
  double stop = 0;
  int count = 2;  // as far apart as a stop, or less

  double at(int index) const { return start + index * (stop - start) / (count - 1); }
};

// The exposures for a reference; both are 0 if it is black. If the median luminance is 0, the median of the
// luminances above 0 replaces it: the paper leaves this case open.
Exposures exposures_of(const image::Image& reference);

// Linear colours as a display shows them at an exposure: tone mapped (ACES, as Narkowicz fits it), linear, in
// [0, 1]. Negative colours count as black.
image::Image exposed(const image::Image& image, double exposure);

struct HdrFlip {
  Exposures exposures;
  Flip flip;
  std::vector<float> map;       // of each pixel, row by row: the greatest error …
  std::vector<float> exposure;  // … and the first exposure at which it is found, in stops
};

// HDR-FLIP of two linear 1- or 3-channel pictures of one size, of which `b` is the reference. Empty if a
// value is not finite.
std::optional<HdrFlip> hdr_flip(const image::Image& a, const image::Image& b);

}  // namespace eyeray::engine::compare
