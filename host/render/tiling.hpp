// Divides a picture into shards, one for each machine. Each tile of the picture belongs to one shard, with
// all samples of its pixels.
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

// The most shards that a picture may have.
constexpr int most_shards = 1 << 20;

// The tiles of a picture, from its top left on, row by row. A tile is a block of noise high and whole blocks
// wide, except at the right and at the bottom of the picture: so each block is measured by one shard. A tile
// is a dispatch. A shard of more pixels has more tiles and larger ones, but at most `tiles_wanted`, and none
// narrower than `least_width`.
//
// Each shard gets one of the first `shards` tiles, one of the next `shards`, and so on, each time in a new
// random order. So the shards' numbers of tiles differ by at most one, and every shard has tiles all over the
// picture, costly parts included. The order depends only on the number of the group of tiles, and is the same
// on every machine.
class Tiling {
 public:
  // `width`, `height`, `shards` ≥ 1.
  Tiling(int width, int height, int shards);

  static constexpr int tile_height = film::noise_block;
  static constexpr int tiles_wanted = 16;
  static constexpr int least_width = 4 * film::noise_block;

  int tile_width() const { return tile_width_; }  // except for the last tile of a row
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int count() const { return columns_ * rows_; }
  Rect tile(int number) const;
  // The index of the shard that the tile belongs to.
  int owner(int number) const { return owners_[size_t(number)]; }

 private:
  int width_, height_;
  int tile_width_, columns_, rows_;
  std::vector<int> owners_;
};

// The tiles of one shard, stacked: one below the other, each as high as a whole tile. The shard's machine
// renders this stack as its picture. The area to the right of a narrow tile or below a low one has no pixels,
// and gets no samples.
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
  // The tiles, from the stack's top on, in pixels of the whole picture: the offset of `area` is included.
  const std::vector<Rect>& tiles() const { return tiles_; }
  // Rectangles of the tiles' pixels in rows [row, row + height) of the stack, in pixels of the stack.
  std::vector<Rect> parts(int row, int height) const;
  // The rectangle in the picture for a rectangle of parts().
  Rect in_picture(const Rect& part) const;

 private:
  Shard shard_;
  std::vector<Rect> tiles_;
  int width_ = 0;
  int64_t pixels_ = 0;
};

}  // namespace eyeray::engine::render
