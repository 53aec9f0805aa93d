// Pictures sampled at the corners of their pixels, each the mean of its four: the sampling of Haines'
// published statistics (A Proposal for Standard Graphics Environments, IEEE CG&A 7(11), 1987).
#pragma once

#include "host/core/rect.hpp"
#include "host/render/sums.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::render {

// Makes the picture one of the corners, a row and a column larger: the centres of its pixels are where the
// corners of the old ones were. One sample each.
void sample_corners(Scene& scene);
// The corners of some pixels, as a part of that picture.
Rect corners_of(const Rect& pixels);

// Rows of corners to rows of pixels, one fewer: means of colours, hits, rays, samples and kinds of rays, and
// the flags of all four.
class CornerMean {
 public:
  // The rows of pixels that are whole with the next rows of corners, from the top down; images without height
  // where none is. What is flagged are corners.
  FinishedRows add(const FinishedRows& corners);

 private:
  // The last row of corners so far; empty at the start.
  image::Image last_color_, last_hits_, last_rays_, last_samples_, last_kinds_, last_flagged_;
};

}  // namespace eyeray::render
