// Tests the error bounds that tessellations state, for points of the surface and for points of the triangles.
#include "host/raster/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "host/raster/flat_regions.hpp"
#include "host/shapes/make.hpp"
#include "tests/support/doctest.hpp"
#include "tests/support/random.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::raster;
using namespace eyeray::engine::test;

namespace {

// The distance of p from the triangle, by Ericson: Real-Time Collision Detection, 5.1.5, 2005.
double distance_to(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const auto& [a, b, c] = triangle;
  const Vec3 normal = glm::cross(b - a, c - a);
  const auto inside = [&](const Vec3& from, const Vec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) >= 0;
  };
  if (inside(a, b) && inside(b, c) && inside(c, a) && normal != Vec3(0))
    return std::fabs(glm::dot(p - a, normal)) / glm::length(normal);
  double least = 1e300;
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
    const Vec3 along = to - from;
    const double share = std::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
    least = std::min(least, glm::length(p - from - along * share));
  }
  return least;
}

double distance_to(const Tessellation& all, const Vec3& p) {
  double least = 1e300;
  for (const auto& [a, b, c] : all.triangles)
    least = std::min(least, distance_to({all.points[a], all.points[b], all.points[c]}, p));
  return least;
}

std::vector<std::pair<std::string, std::unique_ptr<Shape>>> curved_shapes(const Mat4& map) {
  std::vector<std::pair<std::string, std::unique_ptr<Shape>>> all;
  const auto add = [&](const char* name, std::unique_ptr<Shape> shape) {
    all.emplace_back(name, std::move(shape));
  };
  add("sphere", shapes::make_sphere({0.3, 0.1, 0}, 0.9, map));
  add("ellipsoid", shapes::make_ellipsoid({0, 0, 0}, {0.4, 1, 0.7}, map));
  add("cylinder", shapes::make_cylinder({0, -1, 0}, {0.2, 1, 0}, 0.6, false, map));
  add("open cylinder", shapes::make_cylinder({0, -1, 0}, {0.2, 1, 0}, 0.6, true, map));
  add("cone", shapes::make_cone({0, -1, 0}, {0, 1, 0}, 0.8, 0, false, map));
  add("cut cone", shapes::make_cone({0, -1, 0}, {0, 1, 0}, 0.8, 0.3, false, map));
  add("paraboloid", shapes::make_paraboloid({0, -1, 0}, {0, 1, 0}, 0.8, false, map));
  add("hyperboloid", shapes::make_hyperboloid({0, -1, 0}, {0, 1, 0}, 0.9, 0.7, 0.4, false, map));
  add("capsule", shapes::make_capsule({0, -0.7, 0}, {0, 0.7, 0}, 0.5, map));
  add("round cone", shapes::make_capsule({0, -0.7, 0}, {0, 0.7, 0}, 0.5, map, 0.2));
  add("round cone with a tip", shapes::make_capsule({0, -0.7, 0}, {0, 0.7, 0}, 0.1, map, 0.6));
  add("disk", shapes::make_disk({0, 0, 0}, {0, 1, 0.3}, 1, 0.4, map));
  add("torus", shapes::make_torus({0, 0, 0}, {0, 1, 0}, 0.8, 0.3, map));
  for (const double e : {0.1, 0.5, 1.0, 1.7, 2.0})
    for (const double n : {0.1, 1.3, 2.0})
      add("superellipsoid", shapes::make_superellipsoid({0, 0, 0}, {1, 0.8, 0.9}, e, n, map));
  std::array<Vec3, 16> net;
  for (size_t i = 0; i < 16; ++i)
    net[i] = {double(i % 4) / 2 - 0.75, (i % 3 == 0 ? 0.6 : -0.2) + 0.1 * double(i / 4),
              double(i / 4) / 2 - 0.75};
  add("bezier", shapes::make_bezier(net, map));
  return all;
}

}  // namespace

TEST_CASE("a surface and its triangles are within the bound of each other, at every point") {
  const Mat4 skewed = glm::rotate(glm::scale(Mat4(1.0), Vec3(1, 2, 0.7)), 0.6, Vec3(1, 2, 3));
  Random random(7);
  for (const Mat4& map : {Mat4(1.0), skewed}) {
    for (const auto& named : curved_shapes(map)) {
      const std::string& name = named.first;
      const Shape* const shape = named.second.get();
      for (const double tolerance : {0.1, 0.01}) {
        CAPTURE(name);
        CAPTURE(tolerance);
        const auto drawn = tessellate(shape->form(), Mat4(1.0), tolerance);
        REQUIRE(drawn.has_value());
        REQUIRE(drawn->triangles.size() > 2);
        // The tessellation is about as fine as requested.
        CHECK(drawn->bound < 4 * tolerance);
        int hits = 0;
        for (int i = 0; i < 60; ++i) {
          const Vec3 from = random.direction() * 5.0;
          const Ray ray{from, random.point(0.8) - from};
          const auto hit = shape->intersect(ray);
          if (!hit || hit->iteration_limit) continue;
          ++hits;
          CHECK(distance_to(*drawn, ray.o + ray.d * hit->t) <= drawn->bound + 1e-9);
        }
        CHECK(hits > 5);
        // From the middle of a triangle, some line hits the surface within the bound.
        for (int i = 0; i < 60; ++i) {
          const auto& [a, b, c] = drawn->triangles[size_t(random.below(int(drawn->triangles.size())))];
          const Vec3 corners[] = {drawn->points[a], drawn->points[b], drawn->points[c]};
          const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
          const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
          double least = 1e300;
          const auto look = [&](const Vec3& way) {
            const double back = 1e-6 + drawn->bound;
            if (const auto hit = shape->intersect({middle - way * back, way}))
              least = std::min(least, std::fabs(hit->t - back));
          };
          look(glm::normalize(normal));
          look(-glm::normalize(normal));
          for (int k = 0; k < 400 && least > drawn->bound; ++k) look(random.direction());
          CHECK(least <= drawn->bound + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("the bound includes a transform's scale: twice as large, twice the bound") {
  const auto shape = shapes::make_torus({0, 0, 0}, {0, 1, 0}, 0.8, 0.3);
  const auto plain = tessellate(shape->form(), Mat4(1.0), 0.01);
  const auto large = tessellate(shape->form(), glm::scale(Mat4(1.0), Vec3(2)), 0.02);
  CHECK(large->bound == doctest::Approx(2 * plain->bound));
  CHECK(large->points[5] == 2.0 * plain->points[5]);
}

TEST_CASE("tessellations of flat shapes are exact: they cover the region once") {
  const std::vector<std::vector<Vec3>> comb = {
      {{0, 0, 1}, {4, 0, 1}, {4, 3, 1}, {3, 1, 1}, {2, 3, 1}, {1, 1, 1}, {0, 3, 1}},
      {{0.5, 0.2, 1}, {3.5, 0.2, 1}, {2, 0.8, 1}}};
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  add_region(comb, points, triangles);
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += glm::length(glm::cross(points[b] - points[a], points[c] - points[a])) / 2;
  // The comb is 4 × 3 without two triangles of 2 × 2, and without its hole.
  CHECK(area == doctest::Approx(12 - 2 - 2 - 0.9));

  const auto shape = shapes::make_box({0, 0, 0}, {1, 2, 3});
  const auto box = tessellate(shape->form(), Mat4(1.0), 1);
  CHECK(box->bound == 0);
  double sides = 0;
  for (const auto& [a, b, c] : box->triangles)
    sides += glm::length(glm::cross(box->points[b] - box->points[a], box->points[c] - box->points[a])) / 2;
  CHECK(sides == doctest::Approx(22));
}

TEST_CASE("shapes without a tessellation are reported as such") {
  CHECK_FALSE(tessellate(shapes::make_bilinear({Vec3(0, 0, 0), {1, 0, 0}, {1, 1, 1}, {0, 1, 0}})->form(),
                         Mat4(1.0), 0.1)
                  .has_value());
  const auto saddle = shapes::make_quadric({{1, 0, -1}, {0, 0, 0}, {0, -1, 0}, 0}, Vec3(-1), Vec3(1), true);
  CHECK_FALSE(tessellate(saddle->form(), Mat4(1.0), 0.1).has_value());
}
