// Images as planes with a margin, so that windows around pixels need no cases at the picture's border.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::denoise {

constexpr int window_radius = 6;  // a pixel's neighbours: 13 × 13
constexpr int patch_radius = 3;   // two pixels are compared by the 7 × 7 around each
constexpr int margin = window_radius + patch_radius;

// Float planes of one size, the picture's and a margin around it. All values are 0 at first.
class Planes {
 public:
  Planes() = default;
  Planes(int width, int height, int count)
      : width_(width), height_(height), count_(count), values_(size_t(count) * plane_size() + beyond) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int count() const { return count_; }
  // The value at (x, y); x and y may lie up to `margin` outside of the picture. Those after it are to its
  // right, and then in the next row.
  float* at(int plane, int x, int y) { return &values_[index(plane, x, y)]; }
  const float* at(int plane, int x, int y) const { return &values_[index(plane, x, y)]; }

  // Sets the margin's values to those of the nearest pixels.
  void extend() {
    for (int plane = 0; plane < count(); ++plane)
      for (int y = -margin; y < height_ + margin; ++y)
        for (int x = -margin; x < width_ + margin; ++x)
          *at(plane, x, y) = *at(plane, std::clamp(x, 0, width_ - 1), std::clamp(y, 0, height_ - 1));
  }

 private:
  size_t stride() const { return size_t(width_) + 2 * margin; }
  size_t plane_size() const { return stride() * (size_t(height_) + 2 * margin); }
  size_t index(int plane, int x, int y) const {
    return size_t(plane) * plane_size() + size_t(y + margin) * stride() + size_t(x + margin);
  }

  static constexpr size_t beyond = 64;  // values after the last row, for the tiles that reach over it

  int width_ = 0;
  int height_ = 0;
  int count_ = 0;
  std::vector<float> values_;
};

// The means of the first and of the second half of the samples, or their variances.
struct Halves {
  Halves(int width, int height, int count) : first(width, height, count), second(width, height, count) {}
  void extend() {
    first.extend();
    second.extend();
  }
  Planes first, second;
};

// Calls body(x, y) for each pixel.
template <typename Body>
void for_each_pixel(const Planes& planes, const Body& body) {
  parallel_for(0, planes.height(), [&](int y) {
    for (int x = 0; x < planes.width(); ++x) body(x, y);
  });
}

// The mean of each value's square of 2·radius + 1 pixels a side, extended; radius ≤ margin, and `planes` must
// be extended.
Planes blurred(const Planes& planes, int radius);

}  // namespace eyeray::engine::denoise
