// LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator
// for Alternating Images", HPG 2020): the difference that a person sees who flips between two pictures.
#pragma once

#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::compare {

// Statistics of FLIP's error over all pixels, from 0 (the same) to 1.
struct Flip {
  double mean = 0;
  double p95 = 0;  // 95 % of the pixels have no more
  double p99 = 0;
};

// FLIP's error of each pixel, row by row, of two linear 1- or 3-channel pictures of one size. Colours are
// clipped to [0, 1]. The pictures are seen at 67 pixels a degree, as in the paper: a 0.7 m wide display of
// 3840 pixels, 0.7 m away.
std::vector<double> flip_map(const image::Image& a, const image::Image& b);
Flip flip(const image::Image& a, const image::Image& b);
// The summary of a map that flip_map returned.
Flip summary(std::vector<double> map);

}  // namespace eyeray::engine::compare
