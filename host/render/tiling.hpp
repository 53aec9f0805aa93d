// Divides a picture among machines, its shards: into tiles that each belong to one shard, with all samples of
// their pixels.
#pragma once

#include <vector>

#include "host/core/rect.hpp"
#include "host/film/film.hpp"

namespace eyeray::engine::render {

// A share of a picture: number `index`, from 0, of `count`.
struct Shard {
  int index = 0;
  int count = 1;

  friend bool operator==(const Shard&, const Shard&) = default;
};

// Most shards that a picture may have.
constexpr int most_shards = 1 << 20;

// The tiles of a picture, from its top left on, row by row. They are a block of noise high and whole blocks
// wide, but at the right and at the bottom of the picture: so each measurement of a block is one shard's.
// A tile is a dispatch. The more pixels a shard has, the more tiles it has, and the larger these are; but no
// more than `tiles_wanted`, and no narrower than `least_width`.
//
// Shards get one tile each of the first `shards` tiles, one each of the next, and so on, each time in an
// order drawn anew. So all shards have equally many, to within one, and they lie all over the picture,
// wherever it is costly. The orders are drawn from the number of that round of tiles alone, and are the same
// everywhere.
class Tiling {
 public:
  // `width`, `height`, `shards` ≥ 1.
  Tiling(int width, int height, int shards);

  static constexpr int tile_height = film::noise_block;
  static constexpr int tiles_wanted = 16;
  static constexpr int least_width = 4 * film::noise_block;

  int tile_width() const { return tile_width_; }  // of all but the last of a row
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int count() const { return columns_ * rows_; }
  Rect tile(int number) const;
  // The index of the shard that it belongs to.
  int owner(int number) const { return owners_[size_t(number)]; }

 private:
  int width_, height_;
  int tile_width_, columns_, rows_;
  std::vector<int> owners_;
};

// The tiles of one shard, stacked: one below the other, each with the height of a whole one. That is the
// picture which its machine renders; any of it to the right of a narrow tile or below a low one is no
// pixel, and gets no sample.
class ShardTiles {
 public:
  // The shard's tiles of `area`, a part of a picture.
  ShardTiles(const Rect& area, const Shard& shard);

  const Shard& shard() const { return shard_; }
  // The size of the stack of tiles in pixels. The height can be 0 if there are more shards than tiles.
  int width() const { return width_; }
  int height() const { return int(tiles_.size()) * Tiling::tile_height; }
  // The number of pixels to render: less than the stack's area.
  int64_t pixels() const { return pixels_; }
  // In pixels of the picture, `area` included, from the stack's top on.
  const std::vector<Rect>& tiles() const { return tiles_; }
  // The pixels in rows [row, row + height) of the stack, in its pixels.
  std::vector<Rect> parts(int row, int height) const;
  // The position of such a part in the picture.
  Rect in_picture(const Rect& part) const;

 private:
  Shard shard_;
  std::vector<Rect> tiles_;
  int width_ = 0;
  int64_t pixels_ = 0;
};

}  // namespace eyeray::engine::render
