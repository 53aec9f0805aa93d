// A raster of float32 samples, row 0 at the top, channels interleaved.
#pragma once

#include <cstddef>
#include <vector>

namespace eyeray::engine::image {

class Image {
 public:
  Image() = default;
  // All samples are 0. width, height ≥ 0; channels ≥ 1.
  Image(int width, int height, int channels);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  size_t sample_count() const { return samples_.size(); }
  bool same_size(const Image& other) const;

  // The `channels()` samples of pixel (x, y), 0 ≤ x < width, 0 ≤ y < height.
  float* pixel(int x, int y) { return &samples_[index(x, y)]; }
  const float* pixel(int x, int y) const { return &samples_[index(x, y)]; }

  std::vector<float>& samples() { return samples_; }
  const std::vector<float>& samples() const { return samples_; }

 private:
  size_t index(int x, int y) const { return (size_t(y) * size_t(width_) + size_t(x)) * size_t(channels_); }

  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::vector<float> samples_;
};

// The image with 3 channels: a grey image gets equal red, green and blue.
Image in_color(Image image);

}  // namespace eyeray::engine::image
