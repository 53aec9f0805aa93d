// Pictures sampled at the corners of their pixels: each pixel is the mean of its four corners. Haines'
// published statistics are sampled so (A Proposal for Standard Graphics Environments, IEEE CG&A 7(11), 1987).
#pragma once

#include "host/core/rect.hpp"
#include "host/film/film.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

// Turns the scene's picture into a picture of the corners, which is larger by a row and a column. The centres
// of its pixels are the corners of the old pixels; each gets one sample.
void sample_corners(Scene& scene);
// The corners of `pixels`, as a rectangle of the picture of the corners.
Rect corners_of(const Rect& pixels);

// Converts rows of corners to rows of pixels, of which there is one fewer: colours are means, and channels
// follow ChannelType::of_corners.
class CornerMean {
 public:
  // Takes the next rows of corners, from the top down, and returns the rows of pixels that they complete:
  // images of height 0 if none. flagged_pixels counts corners.
  film::Rows add(const film::Rows& corners);

 private:
  // The last row of corners so far, for the colour and for each channel; empty at the start.
  std::vector<image::Image> last_;
};

}  // namespace eyeray::engine::render
