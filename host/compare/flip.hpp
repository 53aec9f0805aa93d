// LDR-FLIP (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator
// for Alternating Images", HPG 2020): the difference that a person sees who flips between two pictures.
#pragma once

#include "host/image/image.hpp"

namespace eyeray::compare {

// The mean over all pixels, 0 (the same) … 1, of two linear 1- or 3-channel pictures of one size, clipped to
// [0, 1]. Seen at 67 pixels a degree, as the paper does: a 0.7 m wide display of 3840 pixels, 0.7 m away.
double mean_flip(const Image& a, const Image& b);

}  // namespace eyeray::compare
