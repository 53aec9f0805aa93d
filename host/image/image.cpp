#include "host/image/image.hpp"

#include "host/core/error.hpp"

namespace eyeray::image {

Image::Image(int width, int height, int channels) : width_(width), height_(height), channels_(channels) {
  CHECK_LE(0, width);
  CHECK_LE(0, height);
  CHECK_LE(1, channels);
  samples_.assign(size_t(width) * size_t(height) * size_t(channels), 0.0f);
}

bool Image::same_size(const Image& other) const {
  return width_ == other.width_ && height_ == other.height_ && channels_ == other.channels_;
}

}  // namespace eyeray::image
