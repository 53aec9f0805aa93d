#include "host/film/noise.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::film {

NoiseBlocks::NoiseBlocks(int picture_width, int picture_height)
    : width(picture_width),
      height(picture_height),
      columns((width + noise_block - 1) / noise_block),
      rows((height + noise_block - 1) / noise_block) {}

Rect NoiseBlocks::block(int column, int row) const {
  const int left = column * noise_block, top = row * noise_block;
  return {left, top, std::min(noise_block, width - left), std::min(noise_block, height - top)};
}

std::vector<double> NoiseBlocks::map(const std::function<double(const Rect& block)>& of) const {
  std::vector<double> values(size_t(columns) * size_t(rows));
  parallel_for(0, rows, [&](int row) {
    for (int column = 0; column < columns; ++column) values[index(column, row)] = of(block(column, row));
  });
  return values;
}

image::Image NoiseBlocks::as_image(const std::vector<double>& values) const {
  CHECK_EQ(values.size(), size_t(columns) * size_t(rows));
  image::Image result(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      *result.pixel(x, y) = float(values[index(x / noise_block, y / noise_block)]);
  return result;
}

double noise_of(double variances, double luminances, double pixels, double shown_as_one) {
  return 1.96 * std::sqrt(variances / pixels) / (luminances / pixels + 0.01 * shown_as_one);
}

}  // namespace eyeray::engine::film
