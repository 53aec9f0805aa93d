// The distances between pixels and their neighbours, measured by the patches around both.
#pragma once

#include <vector>

#include "host/denoise/planes.hpp"

namespace eyeray::engine::denoise {

// The pixels that are handled at a time, so few that their distances fit in a cache.
constexpr int tile_width = 32;
constexpr int tile_height = 16;

// Distances from a tile's pixels to their neighbours.
class Distances {
 public:
  explicit Distances(int radius)
      : radius_(radius),
        size_(2 * radius + 1),
        values_(size_t(size_) * size_t(size_) * tile_width * tile_height) {}

  int radius() const { return radius_; }
  // Sets the distances of the tile whose first pixel is (x, y), by planes of values, and the variance of each
  // and `least` more. Where the tile reaches over the picture's border they mean nothing. `valid`: one plane,
  // 0 for pixels that do not count. As neighbours they are far away.
  void compute(const Planes& values, const Planes& variances, float least, const Planes& valid, int x, int y);
  // The distances to the neighbours (dx, dy) away, of `tile_width` pixels of the tile's row; 0 or more.
  const float* row(int dx, int dy, int row) const { return &values_[index(dx, dy, row)]; }

 private:
  size_t index(int dx, int dy, int row) const {
    const int offset = (dy + radius_) * size_ + dx + radius_;
    return (size_t(offset) * tile_height + size_t(row)) * tile_width;
  }

  int radius_;
  int size_;
  std::vector<float> values_;
};

}  // namespace eyeray::engine::denoise
