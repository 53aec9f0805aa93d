// Tiles: every pixel belongs to a shard, and shares are alike in size and the same everywhere.
#include "host/render/tiling.hpp"

#include <algorithm>
#include <set>

#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;

TEST_CASE("the shards' parts cover the picture, and no pixel twice") {
  test::Random random(5);
  for (int i = 0; i < 60; ++i) {
    const Rect area{random.below(100), random.below(100), 1 + random.below(300), 1 + random.below(90)};
    const int shards = 1 + random.below(i % 3 == 0 ? 200 : 9);
    CAPTURE(area.width);
    CAPTURE(area.height);
    CAPTURE(shards);
    std::vector<int> times(size_t(area.pixels()));
    int64_t pixels = 0;
    for (int shard = 0; shard < shards; ++shard) {
      const ShardTiles tiles(area, {shard, shards});
      pixels += tiles.pixels();
      // Reads the stack a random number of rows at a time.
      for (int row = 0; row < tiles.height();) {
        const int height = std::min(1 + random.below(20), tiles.height() - row);
        for (const Rect& part : tiles.parts(row, height)) {
          CHECK(part.y >= row);
          CHECK(part.y + part.height <= row + height);
          CHECK(part.x + part.width <= tiles.width());
          const Rect rect = tiles.in_picture(part);
          for (int y = rect.y; y < rect.y + rect.height; ++y)
            for (int x = rect.x; x < rect.x + rect.width; ++x)
              ++times.at(size_t(y - area.y) * size_t(area.width) + size_t(x - area.x));
        }
        row += height;
      }
    }
    CHECK(pixels == area.pixels());
    CHECK(std::ranges::count(times, 1) == area.pixels());
  }
}

TEST_CASE("shards' numbers of tiles differ by at most one, and their tiles are spread over the picture") {
  for (const int shards : {1, 2, 7, 64}) {
    const Tiling tiling(1920, 1080, shards);
    CHECK(tiling.count() >= 3 * shards);
    std::vector<int> tiles(static_cast<size_t>(shards));
    for (int i = 0; i < tiling.count(); ++i) ++tiles[size_t(tiling.owner(i))];
    const auto [fewest, most] = std::ranges::minmax(tiles);
    CHECK(most - fewest <= 1);
    // Each shard owns one of every `shards` successive tiles.
    for (int first = 0; first + shards <= tiling.count(); first += shards) {
      std::set<int> owners;
      for (int i = first; i < first + shards; ++i) owners.insert(tiling.owner(i));
      CHECK(owners.size() == size_t(shards));
    }
  }
}

TEST_CASE("the order of tiles matches parts that are already on disk") {
  // A part states only the number of its share, so its tiles must be the same in every version that reads its
  // layout.
  const Tiling tiling(256, 64, 4);
  CHECK(tiling.tile_width() == 256);
  // Values computed by a transcription into another language.
  const std::vector<int> expected{2, 0, 1, 3, 0, 1, 3, 2};
  for (size_t i = 0; i < expected.size(); ++i) CHECK(tiling.owner(int(i)) == expected[i]);
}

TEST_CASE("the last tile of a row and of the picture takes the remaining pixels") {
  const Tiling tiling(70, 45, 9);
  CHECK(tiling.tile_width() == 32);
  CHECK(tiling.columns() == 3);
  CHECK(tiling.rows() == 6);
  CHECK(tiling.tile(2) == Rect{64, 0, 6, 8});
  CHECK(tiling.tile(17) == Rect{64, 40, 6, 5});
  // Few shards have few tiles, as wide as the picture.
  CHECK(Tiling(640, 4800, 2).columns() == 1);
}
