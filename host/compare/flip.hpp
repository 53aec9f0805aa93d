// LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator
// for Alternating Images", HPG 2020): the difference that a person sees who flips between two pictures.
#pragma once

#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::compare {

// Over all pixels, 0 (the same) … 1.
struct Flip {
  double mean = 0;
  double p95 = 0;  // 95 % of the pixels have no more
  double p99 = 0;
};

// Of each pixel of two linear 1- or 3-channel pictures of one size, clipped to [0, 1], row by row. Seen at 67
// pixels a degree, as the paper does: a 0.7 m wide display of 3840 pixels, 0.7 m away.
std::vector<double> flip_map(const image::Image& a, const image::Image& b);
Flip flip(const image::Image& a, const image::Image& b);
// Of such a map.
Flip summary(std::vector<double> map);

}  // namespace eyeray::engine::compare
