#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

namespace {

// z = x·y above the unit square; the normal is (−y, −x, 1).
const std::array<Vec3, 4> saddle = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 1), Vec3(0, 1, 0)};

}  // namespace

TEST_CASE("bilinear: z = xy from above, along the patch, twice, and past it") {
  const auto patch = make_bilinear(saddle);
  const Ray down{{0.5, 0.25, 9}, {0, 0, -1}};
  const auto hit = patch->intersect(down);
  REQUIRE(hit.has_value());
  CHECK(near(hit->t, 8.875, 1e-14));
  const SurfacePoint point = patch->surface(down, *hit);
  CHECK(near(point.position, Vec3(0.5, 0.25, 0.125), 1e-15));
  CHECK(near(point.normal_geometric, glm::normalize(Vec3(-0.25, -0.5, 1)), 1e-15));
  CHECK(near(Vec3(point.uv, 0), Vec3(0.5, 0.25, 0), 1e-15));
  CHECK(distance(*patch, {{1.001, 0.5, 9}, {0, 0, -1}}) == -1);
  CHECK(distance(*patch, {{0.5, 0.5, 0.2}, {0, 0, -1}}) == -1);

  // x = y = s, z = s² + … crosses the diagonal x = y twice: 0.6 s − 0.08 = s² at s = 0.2 and 0.4.
  CHECK(near(distance(*patch, {{0, 0, -0.08}, {1, 1, 0.6}}), 0.2, 1e-14));
  CHECK(near(distance(*patch, {{0.3, 0.3, 0.1}, {1, 1, 0.6}}), 0.1, 1e-14));
  CHECK(distance(*patch, {{0.5, 0.5, 0.22}, {1, 1, 0.6}}) == -1);
}

TEST_CASE("bilinear: the front stays in front under a mirror") {
  const auto patch = make_bilinear(saddle, glm::scale(Mat4(1.0), Vec3(-2, 1, 1)));
  const Ray down{{-1, 0.25, 9}, {0, 0, -1}};
  const auto hit = patch->intersect(down);
  REQUIRE(hit.has_value());
  const SurfacePoint point = patch->surface(down, *hit);
  CHECK(near(point.position, Vec3(-1, 0.25, 0.125), 1e-14));
  CHECK(near(point.normal_geometric, glm::normalize(Vec3(0.125, -0.5, 1)), 1e-14));
}
