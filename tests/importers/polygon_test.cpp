// Cutting polygons. Whatever the shape, the triangles' areas must add up to the polygon's, and none may be
// turned over: then they cover it, once.
#include "host/importers/polygon.hpp"

#include <algorithm>
#include <random>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

double area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& up) {
  return glm::dot(up, glm::cross(b - a, c - a)) / 2;
}

// Cuts the polygon, given in a plane, after laying it in space by `map`.
void check_cut(const std::vector<Vec2>& polygon, const Mat4& map = Mat4(1.0)) {
  std::vector<Vec3> corners;
  for (const Vec2& p : polygon) corners.push_back(Vec3(map * Vec4(p, 0, 1)));
  const Vec3 up = Vec3(map[2]);
  double whole = 0;
  for (size_t i = 0; i < corners.size(); ++i)
    whole += area(corners[0], corners[i], corners[(i + 1) % corners.size()], up);
  Triangulator triangulator;
  double sum = 0;
  const auto& triangles = triangulator.cut(corners);
  CHECK(triangles.size() == polygon.size() - 2);
  for (const auto& [a, b, c] : triangles) {
    const double part = area(corners[a], corners[b], corners[c], up);
    CHECK(part >= -1e-12);
    sum += part;
  }
  CHECK(sum == doctest::Approx(whole));
  CHECK(triangulator.fans() == 0);
}

const Mat4 tilted(Vec4(0.6, 0, -0.8, 0), Vec4(0, -1, 0, 0), Vec4(-0.8, 0, -0.6, 0), Vec4(3, 4, 5, 1));

}  // namespace

TEST_CASE("convex and concave polygons are covered once") {
  const std::vector<std::vector<Vec2>> polygons = {
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},                                  // square
      {{0, 0}, {2, 1}, {0, 2}, {0.5, 1}},                                // arrow: one diagonal is outside
      {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},  // U
      {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}},                  // corners in line
      {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},  // a hole with a
                                                                                         // bridge
  };
  for (const std::vector<Vec2>& polygon : polygons) {
    for (size_t start = 0; start < polygon.size(); ++start) {
      std::vector<Vec2> turned = polygon;
      std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(start), turned.end());
      check_cut(turned);
      check_cut(turned, tilted);
    }
  }
}

TEST_CASE("random stars are covered once") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (const int n : {5, 8, 33, 500}) {
    std::vector<Vec2> star;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      star.push_back(radius(random) * Vec2(std::cos(angle), std::sin(angle)));
    }
    check_cut(star);
    check_cut(star, tilted);
  }
}

TEST_CASE("a concave polygon of too many corners is a fan, and counted") {
  std::vector<Vec3> zigzag;
  for (int i = 0; i < 2000; ++i) zigzag.emplace_back(i, i % 2 == 0 ? 0.0 : -500.0, 0);
  zigzag.emplace_back(1000, 1000, 0);
  Triangulator triangulator;
  CHECK(triangulator.cut(zigzag).size() == 1999);
  CHECK(triangulator.fans() == 1);
}

TEST_CASE("the triangulation of degenerate polygons ends") {
  Triangulator triangulator;
  const double nan = std::nan("");
  CHECK(triangulator.cut({}).empty());
  CHECK(triangulator.cut(std::vector<Vec3>(2)).empty());
  CHECK(triangulator.cut(std::vector<Vec3>(50)).size() == 48);
  CHECK(triangulator.cut(std::vector<Vec3>(50, Vec3(nan))).size() == 48);
  const std::vector<Vec3> bow{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2.5, 0}, {1, 5, 0}};  // crosses itself
  CHECK(triangulator.cut(bow).size() == 3);
}
