// The noise of a picture, measured in blocks of pixels.
#pragma once

#include <functional>
#include <vector>

#include "host/core/rect.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::film {

// Blocks have this many pixels each way, from the picture's top left on.
constexpr int noise_block = 8;

// The blocks of a picture.
struct NoiseBlocks {
  NoiseBlocks(int picture_width, int picture_height);
  // The pixels of a block. Those at the right and at the lower edge may have fewer.
  Rect block(int column, int row) const;
  size_t index(int column, int row) const { return size_t(row) * size_t(columns) + size_t(column); }
  // The values of `of(block)`, row by row.
  std::vector<double> map(const std::function<double(const Rect& block)>& of) const;
  // An image of 1 channel from a value for each block.
  image::Image as_image(const std::vector<double>& values) const;

  int width, height;  // the size of the picture
  int columns, rows;  // the numbers of blocks
};

// The error of pixels relative to their brightness. A pixel's error is half the width of the 95 % interval of
// its luminance, 1.96 times its standard error. The root mean square of these errors is divided by the mean
// luminance plus 1 % of the luminance shown as 1. `variances` (squared standard errors) and `luminances` are
// sums over all `pixels`. The result is NaN if there are none.
double noise_of(double variances, double luminances, double pixels, double shown_as_one);

}  // namespace eyeray::engine::film
