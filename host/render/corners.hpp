// Pictures sampled at the corners of their pixels, each the mean of its four: the sampling of Haines'
// published statistics (A Proposal for Standard Graphics Environments, IEEE CG&A 7(11), 1987).
#pragma once

#include "host/core/rect.hpp"
#include "host/film/film.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

// Makes the picture one of the corners, a row and a column larger: the centres of its pixels are where the
// corners of the old ones were. One sample each.
void sample_corners(Scene& scene);
// The corners of some pixels, as a part of that picture.
Rect corners_of(const Rect& pixels);

// Rows of corners to rows of pixels, one fewer: the mean colours, and channels by
// ChannelType::of_corners.
class CornerMean {
 public:
  // The rows of pixels that are whole with the next rows of corners, from the top down; images without height
  // where none is. What is flagged are corners.
  film::Rows add(const film::Rows& corners);

 private:
  // The last row of corners so far, of the colour and of each channel; none at the start.
  std::vector<image::Image> last_;
};

}  // namespace eyeray::engine::render
