// An executor whose samples come from a formula, so that the driver's results are known exactly, also after
// failures.
#pragma once

#include <bit>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "host/render/render.hpp"
#include "tests/support/empty_scene.hpp"

namespace eyeray::engine::test {

class FakeExecutor : public executors::Executor {
 public:
  // `before_call(n)` is called before the n-th call of sample, from 0; false interrupts, and it may throw.
  explicit FakeExecutor(std::function<bool(int)> before_call = {}) : before_call_(std::move(before_call)) {}

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    const Rect& tile = grid.area;
    if (before_call_ && !before_call_(calls++)) {
      // The samples in `out` must not be used.
      for (PixelSample& sample : out) sample = {Vec3(1e9), 1000, 1000, loop_budget};
      return false;
    }
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        const double value = 1 / (1.0 + tile.x + x + 77 * (tile.y + y) + 0.37 * index);
        const bool flagged = (tile.x + x + tile.y + y) % 5 == 0 && index == 1;
        out[size_t(y) * size_t(tile.width) + size_t(x)] = {Vec3(value, std::sqrt(value), -value), 1 + index,
                                                           uint32_t(tile.y + y) + index,
                                                           flagged ? uint32_t(stack_overflow) : 0u};
      }
    }
    for (size_t i = 0; i < auxiliaries.size(); ++i)
      auxiliaries[i] = {Vec3(1.0 / (1 + index + double(i))), Vec3(0, tile.y + double(i), index), 0};
    return true;
  }
  executors::Probed probe(int, int, uint32_t) override { return {}; }
  double query(const QueryBatch&, std::span<QueryHit>) override { return 0; }
  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    for (size_t i = 0; i < out.size(); ++i) {
      out[i].t = tile.x + double(i % size_t(tile.width));
      out[i].primitive = tile.y + int(i / size_t(tile.width));
    }
  }

  int calls = 0;

 private:
  std::function<bool(int)> before_call_;
};

inline Scene scene_of(int width, int height, int samples) {
  Scene scene = test::empty_scene();
  scene.image = {.width = width, .height = height, .samples = samples};
  return scene;
}

// The memory for sums, in bytes, that makes bands of `rows` rows.
inline size_t band_of_rows(const Scene& scene, int rows) {
  return size_t(rows) * size_t(scene.image.width) * sizeof(film::PixelTotals);
}

inline bool same_bits(const image::Image& a, const image::Image& b) {
  if (!a.same_size(b)) return false;
  for (size_t i = 0; i < a.sample_count(); ++i) {
    if (std::bit_cast<uint32_t>(a.samples()[i]) != std::bit_cast<uint32_t>(b.samples()[i])) return false;
  }
  return true;
}

// True if two renderings are the same in everything except their duration and whether they were resumed.
inline bool same_rendering(const render::Rendering& a, const render::Rendering& b) {
  return same_bits(a.color, b.color) && same_bits(a.hits, b.hits) &&
         same_bits(a.rays_traced, b.rays_traced) && a.rays == b.rays && a.flags == b.flags &&
         a.flagged_pixels == b.flagged_pixels && a.samples_done == b.samples_done;
}

}  // namespace eyeray::engine::test
