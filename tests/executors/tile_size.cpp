// The tiles of a picture on devices whose clock is an equation.
#include "host/executors/tile_size.hpp"

#include <algorithm>
#include <functional>

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

gpu::DeviceInfo device_of(gpu::DeviceType type) {
  gpu::DeviceInfo info;
  info.type = type;
  return info;
}

struct Pass {
  int tiles = 0;
  double longest = 0;  // seconds of a tile
};

// Computes every pixel of the grid. A tile takes `latency`, and `cost(row)` for each pixel of its 8 × 8
// blocks.
Pass compute(const Grid& grid, executors::TileSize& size, const std::function<double(int)>& cost,
             double latency = 0) {
  Pass pass;
  std::vector<int> times(size_t(grid.pixels()));
  for (int x = 0, y = 0; y < grid.height();) {
    const Rect tile = size.next(grid, x, y);
    CHECK(tile.x == x);
    CHECK(tile.y == y);
    double seconds = latency;
    for (int row = tile.y; row < tile.y + tile.height; ++row) {
      const int rows = (row - tile.y) % 8 == 0 ? 8 : 0;
      seconds += cost(grid.area.y + row * grid.stride) * rows * ((tile.width + 7) / 8 * 8);
      for (int column = x; column < x + tile.width; ++column) ++times[size_t(row * grid.width() + column)];
    }
    size.took(grid, tile, seconds);
    pass.longest = std::max(pass.longest, seconds);
    ++pass.tiles;
    x += tile.width;
    if (x == grid.width()) x = 0, y += tile.height;
  }
  CHECK(std::ranges::all_of(times, [](int count) { return count == 1; }));
  return pass;
}

}  // namespace

TEST_CASE("no tile takes longer than 100 ms on a watched device, from the first on") {
  for (const gpu::DeviceType type : {gpu::DeviceType::discrete, gpu::DeviceType::integrated,
                                     gpu::DeviceType::virtual_gpu, gpu::DeviceType::other}) {
    for (const double pixel : {1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
      for (const Grid& grid :
           {Grid(Rect{0, 0, 1920, 1080}), Grid(Rect{5, 7, 333, 250}), Grid(Rect{0, 0, 1, 9}),
            Grid(Rect{0, 0, 641, 480}, 4), Grid(Rect{9, 9, 1, 1}, 8)}) {
        if (double(grid.pixels()) * pixel > 500) continue;
        CAPTURE(pixel);
        CAPTURE(grid.width());
        executors::TileSize size(device_of(type));
        for (int pass = 0; pass < 3; ++pass)
          CHECK(compute(grid, size, [&](int) { return pixel; }).longest <= gpu::longest_dispatch);
      }
    }
  }
}

TEST_CASE("rows that cost 20 times as much as those above do not take longer than 100 ms") {
  const Grid grid(Rect{0, 0, 1920, 1080});
  for (const double pixel : {1e-9, 1e-8, 7e-8}) {
    CAPTURE(pixel);
    executors::TileSize size(device_of(gpu::DeviceType::integrated));
    const auto cost = [&](int row) { return row < 400 ? pixel : 20 * pixel; };
    for (int pass = 0; pass < 4; ++pass) CHECK(compute(grid, size, cost).longest <= gpu::longest_dispatch);
  }
}

TEST_CASE("on a fast GPU two tiles make a picture of 1920 × 1080 from the third sample on") {
  const Grid grid(Rect{0, 0, 1920, 1080});
  executors::TileSize size(device_of(gpu::DeviceType::discrete));
  const auto cost = [](int) { return 1e-9; };
  CHECK(compute(grid, size, cost, 1e-4).tiles < 50);
  compute(grid, size, cost, 1e-4);
  CHECK(compute(grid, size, cost, 1e-4).tiles == 2);
}

TEST_CASE("a tile's latency keeps tiles small only for some samples") {
  const Grid grid(Rect{0, 0, 1920, 1080});
  executors::TileSize size(device_of(gpu::DeviceType::discrete));
  for (int pass = 0; pass < 8; ++pass) compute(grid, size, [](int) { return 1e-9; }, 0.01);
  CHECK(compute(grid, size, [](int) { return 1e-9; }, 0.01).tiles <= 4);
}

TEST_CASE("a CPU computes whole rows, 2^14 pixels at first") {
  const Grid grid(Rect{0, 0, 1000, 100});
  executors::TileSize size(device_of(gpu::DeviceType::cpu));
  CHECK(size.next(grid, 0, 0) == Rect{0, 0, 1000, 16});
  size.took(grid, {0, 0, 1000, 16}, 0.05);
  CHECK(size.next(grid, 0, 16) == Rect{0, 16, 1000, 16});
}
