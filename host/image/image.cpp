#include "host/image/image.hpp"

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::image {

Image::Image(int width, int height, int channels) : width_(width), height_(height), channels_(channels) {
  CHECK_LE(0, width);
  CHECK_LE(0, height);
  CHECK_LE(1, channels);
  samples_.assign(size_t(width) * size_t(height) * size_t(channels), 0.0f);
}

bool Image::same_size(const Image& other) const {
  return width_ == other.width_ && height_ == other.height_ && channels_ == other.channels_;
}

Image in_color(Image image) {
  if (image.channels() == 3) return image;
  Image colored(image.width(), image.height(), 3);
  for (size_t i = 0; i < image.sample_count(); ++i)
    std::fill_n(&colored.samples()[3 * i], 3, image.samples()[i]);
  return colored;
}

}  // namespace eyeray::engine::image
