// Disks, capsules and quadrics, against numbers worked out by hand.
#include <numbers>

#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

namespace {

// The heights at which a ray upward through (x, z) hits the shape.
std::vector<double> heights(const Shape& shape, double x, double z) {
  std::vector<double> all;
  for (double y = -10; const auto hit = shape.intersect({{x, y, z}, {0, 1, 0}});) {
    y += hit->t;
    all.push_back(y);
    y += 1e-9;
  }
  return all;
}

void check_heights(const Shape& shape, double x, double z, const std::vector<double>& expected) {
  const std::vector<double> found = heights(shape, x, z);
  REQUIRE(found.size() == expected.size());
  for (size_t i = 0; i < found.size(); ++i) CHECK(near(found[i], expected[i], 1e-8));
}

const Vec3 downwards(0, -1, 0);

}  // namespace

TEST_CASE("disk: its hole, its rims and its uv") {
  const auto ring = make_disk({1, 2, 3}, {0, 5, 0}, 2, 1);
  for (const double x : {2.0, 2.5, 3.0}) CHECK(distance(*ring, {{x, 7, 3}, downwards}) == 5);
  for (const double x : {1.0, 1.999, 3.001}) CHECK(distance(*ring, {{x, 7, 3}, downwards}) == -1);
  CHECK(distance(*ring, {{-9, 2, 3}, {1, 0, 0}}) == -1);
  CHECK(distance(*make_disk({1, 2, 3}, {0, 5, 0}, 2), {{1, 7, 3}, downwards * 2.0}) == 2.5);

  const SurfacePoint east = surface_hit(*ring, {{2.5, 7, 3}, downwards});
  CHECK(near(east.position, Vec3(2.5, 2, 3), 1e-15));
  CHECK(east.normal == Vec3(0, 1, 0));
  CHECK(near(east.uv.x, 0.875, 1e-15));
  CHECK(near(east.uv.y, 0.5, 1e-15));
  const SurfacePoint south = surface_hit(*ring, {{1, -7, 4.5}, -downwards});
  CHECK(south.normal == Vec3(0, 1, 0));
  CHECK(near(south.uv.x, 0.5, 1e-15));
  CHECK(near(south.uv.y, 0.125, 1e-15));

  // A shear turns y = 2 into y = 2 + x, whose normal is the gradient of −x + y.
  const Mat4 shear{{1, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const auto slope = make_disk({1, 2, 3}, {0, 5, 0}, 2, 1, shear);
  CHECK(near(surface_hit(*slope, {{2.5, 9, 3}, downwards}).position, Vec3(2.5, 4.5, 3), 1e-14));
  CHECK(near(surface_hit(*slope, {{2.5, 9, 3}, downwards}).normal, Vec3(-1, 1, 0) / std::sqrt(2.0), 1e-15));
}

TEST_CASE("paraboloid: y = x² + z², its cap, its tip and its focus") {
  const auto csg = make_paraboloid({0, 0, 0}, {0, 4, 0}, 2);
  const auto bowl = make_paraboloid({0, 0, 0}, {0, 4, 0}, 2, true);
  check_heights(*csg, 1, 0, {1, 4});
  check_heights(*bowl, 1, 0, {1});
  check_heights(*bowl, 0, 0, {0});
  check_heights(*bowl, 2.001, 0, {});
  CHECK(near(distance(*csg, {{-5, 1, 0}, {1, 0, 0}}), 4, 1e-14));
  CHECK(near(distance(*csg, {{0, 1, 0}, {1, 0, 0}}), 1, 1e-14));
  CHECK(surface_hit(*csg, {{1, 10, 0}, downwards}).normal == Vec3(0, 1, 0));
  CHECK(near(surface_hit(*csg, {{0, -3, 0}, -downwards}).normal, Vec3(0, -1, 0), 1e-12));

  // Rays along the axis are reflected to the focus, 2² / (4 · 4) above the tip.
  const SurfacePoint point = surface_hit(*bowl, {{1, 10, 0}, downwards});
  CHECK(near(point.position, Vec3(1, 1, 0), 1e-14));
  CHECK(near(glm::reflect(downwards, point.normal), Vec3(-0.8, -0.6, 0), 1e-14));
  CHECK(near(point.uv.x, 0.5, 1e-15));
  CHECK(near(point.uv.y, 0.25, 1e-15));

  // Mirrored, it opens downward and its outside stays outside.
  const auto hill = make_paraboloid({0, 0, 0}, {0, 4, 0}, 2, true, glm::scale(Mat4(1.0), Vec3(1, -1, 1)));
  CHECK(near(surface_hit(*hill, {{1, 10, 0}, downwards}).normal, Vec3(2, 1, 0) / std::sqrt(5.0), 1e-14));
}

TEST_CASE("hyperboloid: x² + z² = 9 + y², hit up to four times") {
  const auto spool = make_hyperboloid({0, -4, 0}, {0, 4, 0}, 5, 5, 3);
  const auto side = make_hyperboloid({0, -4, 0}, {0, 4, 0}, 5, 5, 3, true);
  const double bend = std::sqrt(7.0);
  check_heights(*spool, 4, 0, {-4, -bend, bend, 4});
  check_heights(*side, 4, 0, {-bend, bend});
  check_heights(*spool, 2, 0, {-4, 4});
  check_heights(*side, 2, 0, {});
  check_heights(*spool, 5.001, 0, {});
  CHECK(near(distance(*spool, {{-10, 0, 0}, {1, 0, 0}}), 7, 1e-14));
  CHECK(near(distance(*spool, {{0, 0, 0}, {1, 0, 0}}), 3, 1e-14));

  const SurfacePoint out = surface_hit(*spool, {{4, -3, 0}, {0, 1, 0}});
  CHECK(near(out.position, Vec3(4, -bend, 0), 1e-14));
  CHECK(near(out.normal, Vec3(4, bend, 0) / std::sqrt(23.0), 1e-14));
  CHECK(near(out.uv.y, (4 - bend) / 8, 1e-14));
  CHECK(near(surface_hit(*spool, {{0, 0, 9}, {0, 0, -1}}).uv.x, 0.25, 1e-15));

  // The waist may be an end, and need not be in the middle: here r² = 9 + y² from y = −4 to 0, and to √7.
  CHECK(near(distance(*make_hyperboloid({0, -4, 0}, {0, 0, 0}, 5, 3, 3), {{-9, -1e-12, 0}, {1, 0, 0}}), 6,
             1e-11));
  check_heights(*make_hyperboloid({0, -4, 0}, {0, bend, 0}, 5, 4, 3), 3.5, 0,
                {-4, -std::sqrt(3.25), std::sqrt(3.25), bend});
}

TEST_CASE("capsule: side, ends, and the seams between them") {
  const auto capsule = make_capsule({0, 0, 0}, {0, 2, 0}, 1);
  check_heights(*capsule, 0, 0, {-1, 3});
  check_heights(*capsule, 0.6, 0, {-0.8, 2.8});
  check_heights(*capsule, 1.001, 0, {});
  for (const double y : {0.0, 1.0, 2.0}) {
    const SurfacePoint point = surface_hit(*capsule, {{10, y, 0}, {-1, 0, 0}});
    CHECK(near(point.position, Vec3(1, y, 0), 1e-14));
    CHECK(near(point.normal, Vec3(1, 0, 0), 1e-14));
    CHECK(near(point.uv.x, 0.5, 1e-15));
    CHECK(near(point.uv.y, (std::numbers::pi / 2 + y) / (std::numbers::pi + 2), 1e-14));
  }
  CHECK(near(surface_hit(*capsule, {{10, 2.6, 0}, {-1, 0, 0}}).normal, Vec3(0.8, 0.6, 0), 1e-14));
  CHECK(near(surface_hit(*capsule, {{0, 9, 0}, downwards}).uv.y, 1, 1e-15));
  CHECK(near(distance(*capsule, {{0, 1, 0}, {0, 1, 0}}), 2, 1e-14));
  CHECK(near(capsule->bounds().min, Vec3(-1, -1, -1), 1e-14));
  CHECK(near(capsule->bounds().max, Vec3(1, 3, 1), 1e-14));
}

TEST_CASE("round cone: side, balls, tip, and a ball that contains the other") {
  const auto round = make_capsule({0, 0, 0}, {0, 2, 0}, 1, Mat4(1.0), 0.5);
  check_heights(*round, 0, 0, {-1, 2.5});
  check_heights(*round, 0.3, 0, {-std::sqrt(1 - 0.09), 2 + std::sqrt(0.25 - 0.09)});
  // The side is 0.25 y + cosine · r = 1.
  const double cosine = std::sqrt(1 - 0.0625), angle = std::acos(-0.25);
  const double side = (1 - 0.9 * cosine) / 0.25;
  check_heights(*round, 0.9, 0, {-std::sqrt(1 - 0.81), side});
  check_heights(*round, 1.001, 0, {});
  const SurfacePoint point = surface_hit(*round, {{0.9, 9, 0}, downwards});
  CHECK(near(point.normal, Vec3(cosine, 0.25, 0), 1e-14));
  CHECK(near(point.uv.x, 0.5, 1e-15));
  const double whole = angle + 0.5 * (std::numbers::pi - angle) + 2 * cosine;
  CHECK(near(point.uv.y, (angle + cosine * (side - 0.9 * 0.25 / cosine)) / whole, 1e-13));
  CHECK(near(surface_hit(*round, {{0, 9, 0}, downwards}).uv.y, 1, 1e-14));
  CHECK(near(round->bounds().max, Vec3(1, 2.5, 1), 1e-14));
  CHECK(near(round->bounds().min, Vec3(-1, -1, -1), 1e-14));

  // A ray along the side, and one that is steeper than the side.
  CHECK(near(distance(*round, {Vec3(cosine, 0.25, 0) * 2.0, Vec3(-cosine, -0.25, 0)}), 1, 1e-14));
  CHECK(near(distance(*round, {{0, 0, 0}, {0, 1, 0.1}}), (4 + std::sqrt(16 - 15.15)) / 2.02, 1e-13));

  const auto tip = make_capsule({0, 0, 0}, {0, 2, 0}, 1, Mat4(1.0), 0);
  check_heights(*tip, 0, 0, {-1, 2});
  const auto ball = make_capsule({0, 0, 0}, {0, 2, 0}, 1, Mat4(1.0), 3.5);
  check_heights(*ball, 0, 0, {-1.5, 5.5});
  check_heights(*ball, 2.1, 0, {2 - 2.8, 2 + 2.8});
}

TEST_CASE("round cone: a point of its surface is as far from one ball, and farther from all others") {
  Random random{3};
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = random.point(1), to = random.point(1);
    const double low = random.uniform(0.05, 1), high = random.uniform(0, 1);
    const auto shape = make_capsule(from, to, low, Mat4(1.0), high);
    const Vec3 o = random.direction() * 5.0;
    const Ray ray{o, unit(glm::mix(from, to, random.uniform(0, 1)) - o)};
    const SurfacePoint point = surface_hit(*shape, ray);
    // The distance from the ball at a share of the axis is convex.
    const auto distance_at = [&](double s, const Vec3& p) {
      return glm::length(p - glm::mix(from, to, s)) - glm::mix(low, high, s);
    };
    const auto least = [&](const Vec3& p) {
      double a = 0, b = 1;
      for (int step = 0; step < 100; ++step) {
        const double s = a + (b - a) / 3, t = b - (b - a) / 3;
        if (distance_at(s, p) < distance_at(t, p))
          b = t;
        else
          a = s;
      }
      return distance_at((a + b) / 2, p);
    };
    CAPTURE(i);
    CHECK(std::fabs(least(point.position)) < 1e-9);
    CHECK(near(least(point.position + point.normal * 0.1), 0.1, 1e-9));
    CHECK(glm::dot(point.normal, ray.d) <= 1e-9);
  }
}

TEST_CASE("quadric: a saddle, two sheets, and a ball cut off by a box") {
  const QuadricValues saddle{.square = {1, 0, -1}, .product = Vec3(0), .linear = {0, -1, 0}, .constant = 0};
  const auto sheet = make_quadric(saddle, Vec3(-1), Vec3(1), true);
  check_heights(*sheet, 0.5, 0, {0.25});
  check_heights(*sheet, 0.5, 0.5, {0});
  check_heights(*sheet, 0, 0.5, {-0.25});
  check_heights(*sheet, 1.001, 0, {});
  const SurfacePoint point = surface_hit(*sheet, {{0.25, 5, 0}, downwards});
  CHECK(near(point.normal, Vec3(0.5, -1, 0) / std::sqrt(1.25), 1e-14));
  CHECK(near(point.uv.x, 0.625, 1e-14));
  CHECK(near(point.uv.y, 0.5, 1e-14));
  const auto csg = make_quadric(saddle, Vec3(-1), Vec3(1));
  check_heights(*csg, 0.5, 0, {0.25, 1});
  CHECK(surface_hit(*csg, {{0.5, 5, 0}, downwards}).normal == Vec3(0, 1, 0));
  CHECK(near(surface_hit(*csg, {{0.5, 5, 0}, downwards}).uv.x, 0.75, 1e-15));

  const QuadricValues sheets{.square = {1, -1, 1}, .product = Vec3(0), .linear = Vec3(0), .constant = 0.25};
  check_heights(*make_quadric(sheets, Vec3(-1), Vec3(1)), 0, 0, {-1, -0.5, 0.5, 1});

  // (x − 3)² + y² + z² = 1, from x = 2.5.
  const QuadricValues ball{.square = Vec3(1), .product = Vec3(0), .linear = {-6, 0, 0}, .constant = 8};
  const auto cut = make_quadric(ball, {2.5, -2, -2}, {4.5, 2, 2});
  CHECK(near(distance(*cut, {Vec3(0), {1, 0, 0}}), 2.5, 1e-14));
  CHECK(surface_hit(*cut, {Vec3(0), {1, 0, 0}}).normal == Vec3(-1, 0, 0));
  const SurfacePoint far_side = surface_hit(*cut, {{3, 0, 0}, {0.6, 0.8, 0}});
  CHECK(near(far_side.position, Vec3(3.6, 0.8, 0), 1e-14));
  CHECK(near(far_side.normal, Vec3(0.6, 0.8, 0), 1e-14));

  // Each product belongs to its pair of coordinates: the gradient of 2xy + 4xz + 8yz is (2y + 4z, 2x + 8z, 4x
  // + 8y).
  const QuadricValues mixed{.square = Vec3(0), .product = {2, 4, 8}, .linear = {0, 0, 0}, .constant = -1};
  const SurfacePoint twisted = surface_hit(*make_quadric(mixed, Vec3(-1), Vec3(1), true), {Vec3(0), Vec3(1)});
  CHECK(near(twisted.position, Vec3(1 / std::sqrt(14.0)), 1e-14));
  CHECK(near(twisted.normal, glm::normalize(Vec3(6, 10, 12)), 1e-14));
}
