#include "host/executors/tile_size.hpp"

#include <algorithm>

namespace eyeray::engine::executors {
namespace {

constexpr int side = 8;  // pixels of a block
constexpr int64_t block = side * side;
constexpr int64_t most_unexplored = 1 << 16;  // pixels of a tile in rows of unknown cost

// The number of blocks along so many pixels.
int64_t blocks(int pixels) {
  return (pixels + side - 1) / side;
}

size_t row_of(const Grid& grid, int y) {
  return size_t(grid.area.y + y * grid.stride);
}

}  // namespace

TileSize::TileSize(const gpu::DeviceInfo& device)
    : watched_(gpu::watched(device)),
      wanted_seconds_(gpu::DispatchSize::wanted_seconds(device)),
      size_(device, most_items) {}

// The number of blocks, from row y on, that one dispatch can compute in time.
int64_t TileSize::affordable(const Grid& grid, int y) const {
  const int64_t across = blocks(grid.width()), most = most_items / block;
  int64_t count = 0;
  for (double left = wanted_seconds_; y < grid.height() && count < most; y += side) {
    const size_t row = row_of(grid, y);
    const double cost = row < costs_.size() ? costs_[row] : 0;
    if (cost == 0) break;
    if (cost * double(across) > left) return count + int64_t(left / cost);
    left -= cost * double(across);
    count += across;
  }
  return count > 0 ? std::min(count, most) : std::min(size_.items(), most_unexplored) / block;
}

Rect TileSize::next(const Grid& grid, int x, int y) const {
  const int width = grid.width(), rows_left = grid.height() - y;
  if (!watched_) return {0, y, width, std::clamp(int(size_.items() / width), 1, rows_left)};
  const int64_t count = affordable(grid, y);
  if (const int64_t strips = count / blocks(width); x == 0 && strips > 0)
    return {0, y, width, int(std::min<int64_t>(strips * side, rows_left))};
  return {x, y, int(std::min<int64_t>(std::max<int64_t>(count, 1) * side, width - x)),
          std::min(side, rows_left)};
}

void TileSize::took(const Grid& grid, const Rect& tile, double seconds) {
  if (!watched_) return size_.took(tile.pixels(), seconds);
  size_.took(blocks(tile.width) * blocks(tile.height) * block, seconds);
  strip_seconds_ = (tile.x == 0 ? 0 : strip_seconds_) + seconds;
  if (tile.x + tile.width < grid.width()) return;
  const size_t begin = row_of(grid, tile.y), end = row_of(grid, tile.y + tile.height);
  if (costs_.size() < end) costs_.resize(end);
  const double cost = strip_seconds_ / double(blocks(grid.width()) * blocks(tile.height));
  std::fill(costs_.begin() + ptrdiff_t(begin), costs_.begin() + ptrdiff_t(end), cost);
}

}  // namespace eyeray::engine::executors
