// Tests of the primitives that the geometry allows at a pixel: no more at a shared edge, more where triangles
// end, and never one that is surely behind.
#include "host/raster/possible.hpp"

#include "host/cameras/make.hpp"
#include "host/raster/judge.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::raster;

namespace {

const Exactness exactness{.snap = 0.01, .depth_error = 1e-6};
const Vec2 center(5.5, 5.5);

View simple_view() {
  const Camera camera{.projection = cameras::make_projection(PerspectiveCamera{60})};
  return {camera, {10, 10}, {0, 0, 10, 10}};
}

// Two triangles around the centre that share the edge x = `split`, at one nearness.
std::vector<ScreenTriangle> halves(double split, double nearness, uint32_t left, uint32_t right) {
  const Vec3 top(split, 0, nearness), bottom(split, 10, nearness);
  return {{{top, bottom, Vec3(-20, 5, nearness)}, left}, {{bottom, top, Vec3(30, 5, nearness)}, right}};
}

ScreenTriangle wall(double nearness, uint32_t id) {
  return {{Vec3(-50, -50, nearness), Vec3(60, -50, nearness), Vec3(5, 90, nearness)}, id};
}

Possible possible(const std::vector<ScreenTriangle>& triangles, bool tessellated = true) {
  return {Viewer::ray, center, triangles, simple_view(), exactness, tessellated};
}

}  // namespace

TEST_CASE("at a shared edge either side may be visible, and nothing behind it") {
  auto triangles = halves(5.505, 1, 1, 2);
  triangles.push_back(wall(0.5, 3));
  const Possible here = possible(triangles);
  CHECK(here.allows(1, 1));
  CHECK(here.allows(2, 1));
  CHECK_FALSE(here.allows(3, 0.5));
  CHECK_FALSE(here.allows_nothing());
}

TEST_CASE("only one side is visible if the edge is farther away than the corners' tolerance") {
  const auto triangles = halves(5.52, 1, 1, 2);
  CHECK(possible(triangles).allows(1, 1));
  CHECK_FALSE(possible(triangles).allows(2, 1));
}

TEST_CASE("where a triangle ends, a surface behind it may be visible, or nothing") {
  auto triangles = halves(5.505, 1, 1, 2);
  triangles.pop_back();
  CHECK(possible(triangles).allows_nothing());
  triangles.push_back(wall(0.5, 3));
  const Possible here = possible(triangles);
  CHECK(here.allows(1, 1));
  CHECK(here.allows(3, 0.5));
  CHECK_FALSE(here.allows_nothing());
}

TEST_CASE("a fold ends a surface: both sides of its edge lie on the same side of the picture") {
  auto triangles = halves(5.505, 1, 1, 2);
  triangles[1].at[2] = Vec3(-30, 5, 0.9);
  CHECK(possible(triangles).allows_nothing());
}

TEST_CASE("a depth other than the triangle's is not allowed") {
  const std::vector<ScreenTriangle> triangles = {wall(1, 1)};
  CHECK(possible(triangles).allows(1, 1 + 0.9e-5));
  CHECK_FALSE(possible(triangles).allows(1, 1 + 3e-5));
  CHECK_FALSE(possible(triangles).allows(1, 1 - 3e-5));
}

TEST_CASE("a rasteriser may have a larger error than a ray in a sliver and beyond a corner") {
  // A sliver, a hundredth of a pixel wide, from depth 1 to 2.
  const std::vector<ScreenTriangle> sliver = {
      {{Vec3(-94.5, 5.495, 1), Vec3(-94.5, 5.505, 1), Vec3(105.5, 5.5, 2)}, 1}};
  const auto at = [&](Viewer viewer, double nearness) {
    return Possible(viewer, center, sliver, simple_view(), exactness, true).allows(1, nearness);
  };
  CHECK(at(Viewer::ray, 1.5));
  CHECK_FALSE(at(Viewer::ray, 1.503));
  CHECK(at(Viewer::rasteriser, 1.503));
  CHECK_FALSE(at(Viewer::rasteriser, 1.6));
  const std::vector<ScreenTriangle> steep = {{{Vec3(5.502, 0, 1), Vec3(5.502, 9, 1), Vec3(9, 5, 8)}, 1}};
  const auto beyond = [&](Viewer viewer) {
    return Possible(viewer, center, steep, simple_view(), exactness, true).allows(1, 0.99);
  };
  CHECK_FALSE(beyond(Viewer::ray));
  CHECK(beyond(Viewer::rasteriser));
}

TEST_CASE("either of two triangles at equal depths may be visible") {
  CHECK(possible({wall(1, 1), wall(1 - 1e-5, 2)}).allows(2, 1 - 1e-5));
  CHECK_FALSE(possible({wall(1, 1), wall(1 - 1e-4, 2)}).allows(2, 1 - 1e-4));
}

TEST_CASE("a tessellation's bound widens edges and depths, but only on request") {
  auto triangles = halves(5.7, 1, 1, 2);
  triangles.pop_back();
  triangles[0].bound = 0.05;
  CHECK_FALSE(possible(triangles, false).allows_nothing());
  CHECK(possible(triangles, true).allows_nothing());
  CHECK(possible(triangles, true).allows(1, 1.04));
}

TEST_CASE("an undrawn surface may hide everything unless it is behind a certainly visible one") {
  CHECK(possible({wall(1, 1)}).may_hide_all(1.5));
  CHECK_FALSE(possible({wall(1, 1)}).may_hide_all(0.9));
  CHECK(possible({}).may_hide_all(0.001));
}

TEST_CASE("a pixel is judged equal, hidden, explained by its cause, or blamed on the wrong side") {
  const View view = simple_view();
  const auto judged = [&](const Seen& traced, const Seen& drawn,
                          const std::vector<ScreenTriangle>& triangles) {
    return judge(traced, drawn, center, triangles, view, exactness);
  };
  const Seen nothing{}, first{true, true, 1, 1}, second{true, true, 2, 1}, other{true, false, 9, 1.5};
  CHECK(judged(first, first, {wall(1, 1)}).verdict == Judgement::equal);
  CHECK(judged(other, first, {wall(1, 1)}).verdict == Judgement::hidden);
  const Judgement edge = judged(first, second, halves(5.505, 1, 1, 2));
  CHECK(edge.verdict == Judgement::explained);
  CHECK(edge.cause == compare::RasterCause::edge);
  CHECK(judged(first, second, {wall(1, 1), wall(1, 2)}).cause == compare::RasterCause::depth);
  const Judgement missed = judged(nothing, first, {wall(1, 1)});
  CHECK(missed.verdict == Judgement::unexplained);
  CHECK(missed.blames_ray);
  const Judgement not_drawn = judged(first, nothing, {wall(1, 1)});
  CHECK(not_drawn.verdict == Judgement::unexplained);
  CHECK_FALSE(not_drawn.blames_ray);
}
