// Tests which samples of random paths gate D excuses.
#include <cmath>

#include "honest_frame.hpp"
#include "host/compare/exact.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::test;

namespace {

constexpr int each = 4;
constexpr double edge = 48.5 + beyond;  // a little right of a column of pixel centres, in the first rows
constexpr int edge_rows = 4;

using Events = std::vector<uint32_t>;

// True if a camera ray x pixels from the left in row y hits the wall on the right, not the wall on the left.
bool on_right(double x, int y) {
  return y < edge_rows && x >= edge;
}
Events events_at(double x, int y) {
  return {7, on_right(x, y) ? 2u : 1u, 9};
}
Vec3 light_at(double x, int y, int sample) {
  return Vec3(0.5, 0.4, 0.3) * (1 + 0.01 * x) * (sample + 1.0) * (on_right(x, y) ? 3.0 : 1.0);
}
uint32_t trail_of(const Events& events) {
  uint32_t trail = 1;
  for (const uint32_t event : events) trail = trail * 31 + event;
  return trail;
}

// A frame of an executor whose samples are displaced by `off` pixels.
Frame path_frame(double off = 0) {
  Frame frame = picture_frame();
  for (int y = 0; y < picture_height; ++y)
    for (int x = 0; x < picture_width; ++x)
      for (int i = 0; i < each; ++i) {
        const double at = x + 0.5 + off;
        frame.samples.push_back({glm::vec3(light_at(at, y, i)), trail_of(events_at(at, y)), 2, 3});
      }
  return frame;
}
TracedSample& sample_at(Frame& frame, int x, int y, int sample) {
  return frame.samples[size_t((y * picture_width + x) * each + sample)];
}

// The reference's paths, with a twin whose samples are displaced by `off` pixels.
PathReference paths(double off = 0) {
  PathReference paths;
  paths.around = [](int sample) -> Reference {
    return [sample](int x, int y, const Vec2& shift, rounding::Coincidence) {
      Neighbour neighbour;
      neighbour.samples = {{light_at(x + 0.5 + shift.x, y, sample), {2, 3}}};
      return neighbour;
    };
  };
  paths.shaders = [off](Pixel pixel, int, uint32_t trail) {
    const Events events = events_at(pixel.x + 0.5 + off, pixel.y);
    return trail_of(events) == trail ? events : Events{};
  };
  paths.reference = [](Pixel pixel, int, const Vec2& shift, int) {
    return events_at(pixel.x + 0.5 + shift.x, pixel.y);
  };
  paths.rounding = [](Pixel) { return 0.0; };
  paths.describe = [](uint32_t event) { return std::to_string(event); };
  return paths;
}

ReferenceComparison compared_paths(const Frame& value, double off = 0) {
  const PathReference reference = paths(off);
  return compare_with_reference(value, path_frame(), picture_reference, {.max_explained = 0.05}, nullptr,
                                &reference);
}

}  // namespace

TEST_CASE("paths that diverge where nearby reference paths do are counted as diverged") {
  const ReferenceComparison comparison = compared_paths(path_frame(5e-5), 5e-5);
  CHECK(comparison.passes());
  CHECK(comparison.paths.pixels == picture_width * picture_height * each);
  CHECK(comparison.paths.explained[size_t(Cause::diverged)] == edge_rows * each);
  CHECK(comparison.paths.explained_pixels() == edge_rows * each);
  CHECK(comparison.paths.worst.seam == Seam::trail);
  CHECK(comparison.paths.worst.parting == "event 1: 2, but the reference's 1");
}

TEST_CASE("one sample's wrong colour fails, though its pixel's mean would hide it") {
  Frame gpu = path_frame();
  sample_at(gpu, 20, 30, 0).color.x += 3e-4f;
  const ReferenceComparison comparison = compared_paths(gpu);
  CHECK_FALSE(comparison.passes());
  CHECK(comparison.paths.unexplained == 1);
  CHECK(comparison.paths.worst.pixel == Pixel{20, 30});
  CHECK(comparison.paths.worst.sample == 0);
  CHECK(comparison.paths.worst.seam == Seam::color);
}

TEST_CASE("a path that no nearby reference path takes, or whose events are unknown, fails") {
  // A sample shows the other wall, far from the edge.
  Frame gpu = path_frame();
  sample_at(gpu, 20, 2, 1) = sample_at(gpu, 60, 2, 1);
  CHECK(compared_paths(gpu, 40).paths.unexplained == 1);
  // The twin's path is another one than the GPU's.
  CHECK(compared_paths(gpu).paths.unexplained == 1);
  // At the edge, but with an event that occurs on neither side.
  gpu = path_frame();
  const Events strange{7, 3, 9};
  sample_at(gpu, 48, 2, 2) = {glm::vec3(9.0f), trail_of(strange), 2, 3};
  PathReference reference = paths();
  reference.shaders = [&](Pixel, int, uint32_t) { return strange; };
  CHECK(compare_with_reference(gpu, path_frame(), picture_reference, {}, nullptr, &reference)
            .paths.unexplained == 1);
}

TEST_CASE("the same path with another number of rays fails") {
  Frame gpu = path_frame();
  sample_at(gpu, 20, 30, 3).rays += 1;
  const ReferenceComparison comparison = compared_paths(gpu);
  CHECK(comparison.paths.unexplained == 1);
  CHECK(comparison.paths.worst.seam == Seam::counts);
}

TEST_CASE("too many diverged paths fail, even if all are explained") {
  const Frame gpu = path_frame(5e-5);
  const PathReference reference = paths(5e-5);
  const ReferenceComparison comparison =
      compare_with_reference(gpu, path_frame(), picture_reference, {.max_explained = 0}, nullptr, &reference);
  CHECK(comparison.paths.unexplained == 0);
  CHECK(comparison.paths.capped_pixels() > comparison.paths.may_be_explained);
  CHECK_FALSE(comparison.passes());
}

TEST_CASE("sums detect errors below every sample's tolerance, everywhere or in one tile") {
  for (const bool everywhere : {true, false}) {
    Frame gpu = path_frame();
    for (int y = 0; y < picture_height; ++y)
      for (int x = 0; x < picture_width; ++x)
        for (int i = 0; i < each; ++i)
          if (everywhere || (x / 8 == 3 && y / 8 == 5)) sample_at(gpu, x, y, i).color *= 1.00009f;
    const ReferenceComparison comparison = compared_paths(gpu);
    CHECK(comparison.paths.unexplained == 0);
    CHECK(comparison.paths.explained_pixels() == 0);
    CHECK(comparison.paired_sum.excess() > 1);
    CHECK_FALSE(comparison.passes());
    if (!everywhere) CHECK(comparison.paired_sum.tile == Rect{24, 40, 8, 8});
  }
}

TEST_CASE("gate A compares samples, too: a colour that the mean hides, and another path") {
  const Frame twin = path_frame();
  Frame gpu = path_frame();
  CHECK(compare_exactly(gpu, twin).passes(0));
  sample_at(gpu, 20, 30, 0).color.y = std::nextafter(sample_at(gpu, 20, 30, 0).color.y, 1.0f);
  CHECK_FALSE(compare_exactly(gpu, twin).passes(0));
  CHECK(compare_exactly(gpu, twin).passes(1));
  sample_at(gpu, 20, 30, 0).trail ^= 1;
  const ExactComparison comparison = compare_exactly(gpu, twin);
  CHECK_FALSE(comparison.passes(64));
  CHECK(comparison.worst.seam == Seam::trail);
}
