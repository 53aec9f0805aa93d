#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

TEST_CASE("superellipsoid: with exponents of 1 an ellipsoid, of 2 an octahedron, and a pillow of power 4") {
  const auto ball = make_superellipsoid({1, 2, 3}, {2, 3, 4}, 1, 1);
  CHECK(near(distance(*ball, {{9, 2, 3}, {-1, 0, 0}}), 6, 1e-13));
  CHECK(near(distance(*ball, {{1, 2, 3}, {0, -2, 0}}), 1.5, 1e-13));
  CHECK(distance(*ball, {{3.001, 2, -9}, {0, 0, 1}}) == -1);
  CHECK(distance(*ball, {{9, 2, 3}, {1, 0, 0}}) == -1);

  const auto octahedron = make_superellipsoid({0, 0, 0}, {1, 1, 1}, 2, 2);
  const SurfacePoint face = surface_hit(*octahedron, {{0.25, 9, 0.25}, {0, -1, 0}});
  CHECK(near(face.position, Vec3(0.25, 0.5, 0.25), 1e-13));
  CHECK(near(face.normal_geometric, glm::normalize(Vec3(1, 1, 1)), 1e-13));
  CHECK(distance(*octahedron, {{0.51, 9, 0.5}, {0, -1, 0}}) == -1);

  // x⁴ + y⁴ + z⁴ = 1 along the diagonal of x and y, and at a point with y = ½, z = 0.
  const auto pillow = make_superellipsoid({0, 0, 0}, {1, 1, 1}, 0.5, 0.5);
  const double corner = std::pow(0.5, 0.25);
  const SurfacePoint edge = surface_hit(*pillow, {{5, 5, 0}, {-1, -1, 0}});
  CHECK(near(edge.position, Vec3(corner, corner, 0), 1e-13));
  CHECK(near(edge.normal_geometric, glm::normalize(Vec3(1, 1, 0)), 1e-13));
  const SurfacePoint side = surface_hit(*pillow, {{-5, 0.5, 0}, {1, 0, 0}});
  const double x = std::pow(1 - 0.0625, 0.25);
  CHECK(near(side.position, Vec3(-x, 0.5, 0), 1e-13));
  CHECK(near(side.normal_geometric, glm::normalize(Vec3(-x * x * x, 0.125, 0)), 1e-13));
}

TEST_CASE("superellipsoid: e is about the y axis, n from pole to pole") {
  const auto column = make_superellipsoid({0, 0, 0}, {1, 1, 1}, 1, 0.5);
  // (x² + z²)² + y⁴ = 1
  CHECK(near(distance(*column, {{3, 0, 4}, {-0.6, 0, -0.8}}), 4, 1e-13));
  CHECK(near(distance(*column, {{5, 0.5, 0}, {-1, 0, 0}}), 5 - std::pow(0.9375, 0.25), 1e-13));
  const auto square = make_superellipsoid({0, 0, 0}, {1, 1, 1}, 0.5, 1);
  // (x⁴ + z⁴)^(1/2) + y² = 1
  CHECK(near(distance(*square, {{5, 0.5, 0}, {-1, 0, 0}}), 5 - std::sqrt(0.75), 1e-13));
  CHECK(near(distance(*square, {{5, 0, 5}, {-1, 0, -1}}), 5 - std::pow(0.5, 0.25), 1e-13));
}

TEST_CASE("superellipsoid: outside stays outside under a mirror, uv are an ellipsoid's") {
  const auto shape =
      make_superellipsoid({0, 0, 0}, {1, 1, 1}, 0.1, 0.1, glm::scale(Mat4(1.0), Vec3(-2, 1, 1)));
  const SurfacePoint point = surface_hit(*shape, {{9, 0.1, 0.2}, {-1, 0, 0}});
  CHECK(near(point.position, Vec3(2, 0.1, 0.2), 1e-9));
  CHECK(near(point.normal_geometric, Vec3(1, 0, 0), 1e-9));
  const auto round = make_superellipsoid({0, 0, 0}, {1, 1, 1}, 0.7, 1.3);
  CHECK(near(Vec3(surface_hit(*round, {{9, 0, 0}, {-1, 0, 0}}).uv, 0), Vec3(0.5, 0.5, 0), 1e-13));
  CHECK(near(Vec3(surface_hit(*round, {{0, 0, 9}, {0, 0, -1}}).uv, 0), Vec3(0.25, 0.5, 0), 1e-13));
  CHECK(near(surface_hit(*round, {{1e-9, 9, 0}, {0, -1, 0}}).uv.y, 1, 1e-8));
}
