// Triangles by the device's rasteriser: where they lie, which is in front, and the errors for triangles that
// cannot be drawn.
#include "host/gpu/rasterizer.hpp"

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// A triangle that covers x + y ≤ `to`, where x and y go from 0 to 1 over the picture; its depth is constant.
std::vector<gpu::RasterVertex> corner(float to, float depth, uint32_t id) {
  const float end = 2 * to - 1;
  return {{-1, -1, depth, id}, {end, -1, depth, id}, {-1, end, depth, id}};
}

// The picture of `width` × `height` after all of `triangles` were drawn.
gpu::RasterPicture draw(gpu::Device& device, const std::vector<std::vector<gpu::RasterVertex>>& triangles,
                        int width = 8, int height = 8) {
  gpu::Rasterizer rasterizer(device, raster_shaders(), width, height);
  for (const auto& triangle : triangles) rasterizer.draw(triangle);
  return rasterizer.read();
}

gpu::Device& drawing_device() {
  static gpu::Device device({.draws = true});
  return device;
}

}  // namespace

TEST_CASE("a triangle covers the pixels whose centres it contains, top left first, for either winding") {
  for (const bool turned : {false, true}) {
    std::vector<gpu::RasterVertex> triangle = corner(0.5, 0.25, 7);
    if (turned) std::swap(triangle[0], triangle[1]);
    const gpu::RasterPicture picture = draw(drawing_device(), {triangle});
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        CAPTURE(x);
        CAPTURE(y);
        // Centres with x + y = 3 lie on the edge itself, which may or may not belong to the triangle.
        if (x + y == 3) continue;
        const bool inside = x + y < 3;
        CHECK(picture.ids[size_t(8 * y + x)] == (inside ? 7 : 0));
        CHECK(picture.depths[size_t(8 * y + x)] == (inside ? 0.25f : 0.0f));
      }
    }
  }
}

TEST_CASE("the nearer triangle is visible in any order of drawing; the first among equally near ones") {
  const auto near = corner(1, 0.75, 1), far = corner(2, 0.5, 2), as_far = corner(2, 0.5, 3);
  for (const auto& order : {std::vector{near, far, as_far}, std::vector{far, as_far, near}}) {
    const gpu::RasterPicture picture = draw(drawing_device(), {order});
    CHECK(picture.ids.front() == 1);
    CHECK(picture.depths.front() == 0.75f);
    CHECK(picture.ids.back() == 2);
    CHECK(picture.depths.back() == 0.5f);
  }
}

TEST_CASE("depth is linear over a triangle, and clipped at 0 and 1") {
  // x + y from 0 to 2 over the picture: depth 1.5 at the top left, −0.5 at the bottom right.
  const std::vector<gpu::RasterVertex> sloping = {{-1, -1, 1.5f, 1}, {3, -1, -0.5f, 1}, {-1, 3, -0.5f, 1}};
  const gpu::RasterPicture picture = draw(drawing_device(), {sloping});
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double depth = 1.5 - (x + y + 1) / 8.0;
      const double drawn = double(picture.depths[size_t(8 * y + x)]);
      if (depth > 1.01 || depth < -0.01)
        CHECK(drawn == 0);
      else if (depth < 0.99 && depth > 0.01)
        CHECK(drawn == doctest::Approx(depth));
    }
  }
}

TEST_CASE("more triangles than a batch are all drawn") {
  std::vector<gpu::RasterVertex> many;
  for (size_t i = 0; i < gpu::Rasterizer::batch; ++i) {
    const auto triangle = corner(1, 0.25, 1);
    many.insert(many.end(), triangle.begin(), triangle.end());
  }
  const auto last = corner(2, 0.5, 2);
  many.insert(many.end(), last.begin(), last.end());
  const gpu::RasterPicture picture = draw(drawing_device(), {many});
  CHECK(picture.ids.front() == 2);
  CHECK(picture.ids.back() == 2);
}

TEST_CASE("core and synchronisation validation report nothing about drawing") {
  for (const char* validation : {"core", "sync"}) {
    for (const bool force_staging : {false, true}) {
      gpu::Device device({.validation = validation, .draws = true, .force_staging = force_staging});
      gpu::Rasterizer rasterizer(device, raster_shaders(), 33, 9);
      for (const uint32_t id : {1u, 2u}) {
        rasterizer.draw(corner(2, 0.25f * float(id), id));
        CHECK(rasterizer.read().ids.back() == id);
      }
      CHECK(device.validation_messages() == std::vector<std::string>{});
    }
  }
}

TEST_CASE("a picture that the device cannot draw is one error with the numbers") {
  const auto refused = error_of([] { gpu::Rasterizer(drawing_device(), raster_shaders(), 1 << 20, 1); });
  CHECK(refused.second == ExitCode::no_device);
  CHECK(contains(refused.first, "draws pictures of "));
  CHECK(contains(refused.first, "1048576×1: leave out --raster"));
}
