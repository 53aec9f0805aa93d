// Values of a picture's pixels in float64.
#pragma once

#include <algorithm>
#include <vector>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::reference {

// Several values for each pixel. Coordinates outside of the picture mean the nearest pixel.
class PixelField {
 public:
  PixelField(int width, int height, int count)
      : width_(width),
        height_(height),
        count_(count),
        values_(size_t(width) * size_t(height) * size_t(count)) {}
  int width() const { return width_; }
  int height() const { return height_; }
  int count() const { return count_; }
  double* at(int x, int y) { return &values_[index(x, y)]; }
  const double* at(int x, int y) const { return &values_[index(x, y)]; }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  template <typename Body>
  void each(const Body& body) const {
    parallel_for(0, height_, [&](int y) {
      for (int x = 0; x < width_; ++x) body(x, y);
    });
  }
  // The mean over a square around each pixel.
  PixelField mean(int radius) const {
    PixelField result(width_, height_, count_);
    const double pixels = (2 * radius + 1) * (2 * radius + 1);
    each([&](int x, int y) {
      for (int j = y - radius; j <= y + radius; ++j)
        for (int i = x - radius; i <= x + radius; ++i)
          for (int c = 0; c < count_; ++c) result.at(x, y)[c] += at(i, j)[c] / pixels;
    });
    return result;
  }

 private:
  size_t index(int x, int y) const {
    return (size_t(std::clamp(y, 0, height_ - 1)) * size_t(width_) + size_t(std::clamp(x, 0, width_ - 1))) *
           size_t(count_);
  }
  int width_, height_, count_;
  std::vector<double> values_;
};

// Fields of the two halves of the samples.
struct HalfFields {
  PixelField first, second;
};

}  // namespace eyeray::engine::reference
