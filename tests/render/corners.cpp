// Pictures sampled at the corners of their pixels.
#include "host/render/corners.hpp"

#include "host/cameras/make.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reference/camera.hpp"
#include "host/render/render.hpp"
#include "host/scene/sampler.hpp"
#include "tests/support/empty_scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;
using namespace eyeray::engine::cameras;

namespace {

// The ray at a point (x, y) in pixels from the upper left.
Ray ray_at(const Scene& scene, double x, double y) {
  return reference::CameraRays(scene.camera, scene.image).ray({x, y});
}

}  // namespace

TEST_CASE("the pixels' centres are where the corners were, for every camera") {
  Scene scene = test::empty_scene();
  scene.camera.eye = {1, 2, 3};
  scene.image = {.width = 7, .height = 5, .samples = 16, .pattern = SamplePattern::jittered};
  std::vector<std::shared_ptr<const Projection>> projections = {make_projection(OrthographicCamera{1.5})};
  for (const FovAxis axis : {FovAxis::horizontal, FovAxis::vertical, FovAxis::shorter, FovAxis::diagonal})
    projections.push_back(make_projection(PerspectiveCamera{45, axis}));
  for (const auto& projection : projections) {
    scene.camera.projection = projection;
    Scene corners = test::empty_scene();
    corners.camera = scene.camera;
    corners.image = scene.image;
    sample_corners(corners);
    REQUIRE(corners.image.width == 8);
    REQUIRE(corners.image.height == 6);
    CHECK(corners.image.samples == 1);
    CHECK(corners.image.pattern == SamplePattern::regular);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(7, 0), std::pair(3, 2), std::pair(7, 5)}) {
      const Ray corner = ray_at(corners, x + 0.5, y + 0.5), pixel = ray_at(scene, x, y);
      CHECK(glm::distance(corner.o, pixel.o) < 1e-15);
      CHECK(glm::distance(corner.d, pixel.d) < 1e-15);
    }
  }
}

TEST_CASE("a pixel is the mean of its corners, however the rows are delivered") {
  const int width = 4, height = 6;
  const film::Channels channels = film::parse_channels("hits,flags");
  film::Rows all(0, width, height, channels);
  image::Image &hits = all.values[0], &flags = all.values[1];
  *flags.pixel(2, 3) = float(stack_overflow);
  *flags.pixel(3, 3) = float(media_overflow);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) all.color.pixel(x, y)[c] = float(x * x + 10 * y * y + 100 * c);
      *hits.pixel(x, y) = float(x * y);
    }
  }
  for (const int rows : {1, 2, 4, 6}) {
    CAPTURE(rows);
    CornerMean mean;
    int next = 0;
    for (int first = 0; first < height; first += rows) {
      const int count = std::min(rows, height - first);
      film::Rows some(first, width, count, channels);
      std::copy_n(all.color.pixel(0, first), some.color.sample_count(), some.color.pixel(0, 0));
      for (size_t i = 0; i < channels.size(); ++i)
        std::copy_n(all.values[i].pixel(0, first), some.values[i].sample_count(), some.values[i].pixel(0, 0));
      some.flags = first == 0 ? uint32_t(stack_overflow) : 0u;
      const film::Rows pixels = mean.add(some);
      CHECK(pixels.flags == some.flags);
      CHECK(pixels.first == next);
      REQUIRE(pixels.color.width() == width - 1);
      REQUIRE(pixels.color.height() == pixels.values[0].height());
      for (int row = 0; row < pixels.color.height(); ++row, ++next) {
        for (int x = 0; x < width - 1; ++x) {
          const int y = next;
          const float squares =
              float(x * x + (x + 1) * (x + 1)) / 2 + 10 * float(y * y + (y + 1) * (y + 1)) / 2;
          for (int c = 0; c < 3; ++c) CHECK(pixels.color.pixel(x, row)[c] == squares + float(100 * c));
          const bool below = y == 2 || y == 3;
          CHECK(*pixels.values[1].pixel(x, row) == (!below || x == 0 ? 0.0f : x == 1 ? 2.0f : 3.0f));
          CHECK(*pixels.values[0].pixel(x, row) == float((2 * x + 1) * (2 * y + 1)) / 4);
        }
      }
    }
    CHECK(next == height - 1);
  }
}
