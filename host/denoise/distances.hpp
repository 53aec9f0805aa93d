// The distances between pixels and their neighbours, measured by the patches around both.
#pragma once

#include <algorithm>
#include <vector>

#include "host/denoise/planes.hpp"

namespace eyeray::engine::denoise {

// The pixels that are handled at a time, so few that their distances fit in a cache.
constexpr int tile_width = 32;
constexpr int tile_height = 16;

// The weight of a neighbour at distance x: exp(−x) to 0.03, and 0 from 16 on; the same on every machine.
inline float weight_at(float x) {
  const float part = std::max(0.0f, 1 - x * 0.0625f);
  const float square = part * part, fourth = square * square, eighth = fourth * fourth;
  return eighth * eighth;
}

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
  //
  // After Rousselle, Manzi and Zwicker, "Robust Denoising using Feature and Color Information" (2013),
  // section 3. A squared difference, less the part that noise adds, is divided by the noise. The mean over
  // the patch is the distance. Two things differ from there. The noise of the neighbour counts only up to
  // that of the pixel, so one without noise accepts no noisy neighbour that differs. The pixels themselves
  // count for at least a quarter, so edges stay sharp.
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
