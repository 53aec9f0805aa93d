// The tiles of a picture, each computed by one dispatch.
#pragma once

#include <cstdint>
#include <vector>

#include "host/core/grid.hpp"
#include "host/gpu/dispatch_size.hpp"

namespace eyeray::engine::executors {

// The most items of one dispatch: for pixels, 32 MiB of samples.
inline constexpr int64_t most_items = 1 << 20;

// The size of the tiles of one kernel. On a CPU they are rows. On a watched device (gpu/dispatch_size.hpp)
// the first tile is one block, the 8 × 8 pixels of a workgroup. Tiles of rows that the kernel has not
// computed before stay small, since glass may follow sky; the others are as large as the rows' last durations
// allow.
class TileSize {
 public:
  explicit TileSize(const gpu::DeviceInfo& device);

  // The tile at column x and row y of the grid, in pixels of the grid. A strip of blocks that does not fit
  // into one tile is completed from left to right.
  Rect next(const Grid& grid, int x, int y) const;
  void took(const Grid& grid, const Rect& tile, double seconds);

 private:
  int64_t affordable(const Grid& grid, int y) const;

  bool watched_;
  double wanted_seconds_;
  gpu::DispatchSize size_;     // in pixels
  double strip_seconds_ = 0;   // the duration of the present strip's tiles so far
  std::vector<double> costs_;  // the seconds of a block in each row of the picture; 0 if unknown
};

}  // namespace eyeray::engine::executors
