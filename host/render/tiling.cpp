#include "host/render/tiling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.hpp"

namespace eyeray::engine::render {
namespace {

// A shard of P pixels has √(P / 2048) tiles of √(2048 P) pixels each. More tiles make shares more alike;
// larger tiles cost less, since a dispatch costs as much CPU time as some thousand samples
// (docs/many-machines.md).
constexpr double pixels_by_tiles = 2048;
constexpr int64_t least_tiles = 2;

int divided_up(int64_t value, int64_t divisor) {
  return int((value + divisor - 1) / divisor);
}

// Numbers that look random, the same on every machine: SplitMix64 (Steele, Lea and Flood, "Fast splittable
// pseudorandom number generators", OOPSLA 2014).
class SplitMix {
 public:
  explicit SplitMix(uint64_t seed) : state_(seed) {}
  // A number from 0 to `end` − 1. Its bias of one in 2³² is negligible for shuffling.
  uint32_t below(uint32_t end) { return uint32_t((next() >> 32) * end >> 32); }

 private:
  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }

  uint64_t state_;
};

}  // namespace

Tiling::Tiling(int width, int height, int shards)
    : width_(width), height_(height), rows_(divided_up(height, tile_height)) {
  CHECK(width >= 1 && height >= 1 && shards >= 1);
  const double pixels_a_shard = double(int64_t{width} * height / shards);
  const int64_t tiles_a_shard =
      std::clamp(int64_t(std::sqrt(pixels_a_shard / pixels_by_tiles)), least_tiles, int64_t{tiles_wanted});
  const int columns_wanted = divided_up(tiles_a_shard * shards, rows_);
  const int blocks = divided_up(width, film::noise_block);
  tile_width_ = std::max(blocks / columns_wanted * film::noise_block,
                         std::min(least_width, blocks * film::noise_block));
  columns_ = divided_up(width, tile_width_);

  owners_.resize(size_t(count()));
  std::vector<int> order(static_cast<size_t>(shards));
  for (int first = 0; first < count(); first += shards) {
    SplitMix random{uint64_t(first / shards)};
    std::iota(order.begin(), order.end(), 0);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(uint32_t(i))]);
    std::copy_n(order.begin(), std::min(shards, count() - first), owners_.begin() + first);
  }
}

Rect Tiling::tile(int number) const {
  const int x = number % columns_ * tile_width_, y = number / columns_ * tile_height;
  return {x, y, std::min(tile_width_, width_ - x), std::min(tile_height, height_ - y)};
}

ShardTiles::ShardTiles(const Rect& area, const Shard& shard) : shard_(shard) {
  const Tiling tiling(area.width, area.height, shard.count);
  width_ = std::min(tiling.tile_width(), area.width);
  for (int i = 0; i < tiling.count(); ++i) {
    if (tiling.owner(i) != shard.index) continue;
    const Rect tile = tiling.tile(i);
    tiles_.push_back({area.x + tile.x, area.y + tile.y, tile.width, tile.height});
    pixels_ += tile.pixels();
  }
}

std::vector<Rect> ShardTiles::parts(int row, int height) const {
  std::vector<Rect> parts;
  for (int i = row / Tiling::tile_height; i * Tiling::tile_height < row + height; ++i) {
    const Rect& tile = tiles_[size_t(i)];
    const int top = i * Tiling::tile_height;
    const int first = std::max(row, top), last = std::min(row + height, top + tile.height);
    if (first < last) parts.push_back({0, first, tile.width, last - first});
  }
  return parts;
}

Rect ShardTiles::in_picture(const Rect& part) const {
  const Rect& tile = tiles_[size_t(part.y / Tiling::tile_height)];
  return {tile.x + part.x, tile.y + part.y % Tiling::tile_height, part.width, part.height};
}

}  // namespace eyeray::engine::render
