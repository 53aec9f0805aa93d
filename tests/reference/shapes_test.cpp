#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::test;

TEST_CASE("sphere: from outside, inside, behind and beside") {
  const auto sphere = make_sphere({1, 2, 3}, 2);
  CHECK(distance(*sphere, {{1, 2, 10}, {0, 0, -1}}) == 5);
  CHECK(distance(*sphere, {{1, 2, 10}, {0, 0, -2}}) == 2.5);
  CHECK(distance(*sphere, {{1, 2, 3}, {0, 0, -1}}) == 2);
  CHECK(distance(*sphere, {{1, 2, 4}, {0, 0, -1}}) == 3);
  CHECK(distance(*sphere, {{1, 2, -10}, {0, 0, -1}}) == -1);
  CHECK(distance(*sphere, {{3.0001, 2, 10}, {0, 0, -1}}) == -1);
  const SurfacePoint point = surface_hit(*sphere, {{1, 2, 10}, {0, 0, -1}});
  CHECK(point.position == Vec3(1, 2, 5));
  CHECK(point.normal_geometric == Vec3(0, 0, 1));
  CHECK(sphere->bounds().min == Vec3(-1, 0, 1));
  CHECK(sphere->bounds().max == Vec3(3, 4, 5));
}

TEST_CASE("sphere: a point aimed at is a point hit, at every scale and distance") {
  Dice dice;
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const double radius = dice.scale(-4, 4);
    const Vec3 center = dice.in_box(10 * radius);
    const auto sphere = make_sphere(center, radius);
    const Vec3 n = dice.direction();
    const Vec3 back = glm::normalize(n + 0.9 * dice.direction());
    const double away = radius * dice.scale(-3, 4);
    const Vec3 p = center + radius * n;
    const Ray ray{p + away * back, -back};
    const auto hit = sphere->intersect(ray);
    REQUIRE(hit.has_value());
    const SurfacePoint point = sphere->surface(ray, *hit);
    worst = std::max(worst, std::abs(hit->t - away) / (away + 10 * radius));
    CHECK(near(glm::length(point.position - center), radius, point.position_error));
  }
  MESSAGE("greatest error of t, relative: " << worst);
  CHECK(worst < 1e-11);
}

TEST_CASE("sphere: uv run eastward and northward") {
  const auto uv = [](const Shape& shape, const Vec3& from) {
    return surface_hit(shape, {from * 5.0, -from}).uv;
  };
  const auto sphere = make_sphere({0, 0, 0}, 1);
  CHECK(near(uv(*sphere, {1, 0, 0}).x, 0.5, 1e-15));
  CHECK(near(uv(*sphere, {0, 0, 1}).x, 0.25, 1e-15));
  CHECK(near(uv(*sphere, {0, 0, -1}).x, 0.75, 1e-15));
  CHECK(uv(*sphere, {-1, 0, 0}).x == 0);
  CHECK(uv(*sphere, {-1, 0, -1e-20}).x == 0);  // 1 is taken as 0
  CHECK(uv(*sphere, {0, 1, 0}).y == 1);
  CHECK(uv(*sphere, {0, -1, 0}).y == 0);
  CHECK(near(uv(*sphere, {1, 0, 0}).y, 0.5, 1e-15));

  // The uv turn and are mirrored with the sphere.
  const auto turned = make_sphere({0, 0, 0}, 1, glm::rotate(Mat4(1.0), glm::radians(90.0), Vec3(0, 1, 0)));
  CHECK(near(uv(*turned, {0, 0, -1}).x, 0.5, 1e-15));
  const auto mirrored = make_sphere({0, 0, 0}, 1, glm::scale(Mat4(1.0), Vec3(1, 1, -1)));
  CHECK(near(uv(*mirrored, {0, 0, -1}).x, 0.25, 1e-15));
  const auto moved = make_sphere({1, 0, 0}, 1, glm::scale(Mat4(1.0), Vec3(3)));
  CHECK(near(surface_hit(*moved, {{3, 0, 9}, {0, 0, -1}}).position, Vec3(3, 0, 3), 1e-14));
}

TEST_CASE("plane: both sides, parallel and behind") {
  const auto plane = make_plane({0, 2, 0}, {0, 3, 0});
  CHECK(distance(*plane, {{0, 5, 0}, {0, -1, 0}}) == 3);
  CHECK(distance(*plane, {{0, 0, 0}, {0, 1, 0}}) == 2);
  CHECK(distance(*plane, {{0, 5, 0}, {1, 0, 0}}) == -1);
  CHECK(distance(*plane, {{0, 2, 0}, {1, 0, 0}}) == -1);
  CHECK(distance(*plane, {{0, 5, 0}, {0, 1, 0}}) == -1);
  const SurfacePoint far = surface_hit(*plane, {{0, 3, 0}, {1, -1e-9, 0.3}});
  CHECK(near(far.position.y, 2, far.position_error));
  CHECK(near(far.position.x / 1e9, 1, 1e-12));
  CHECK(far.normal == Vec3(0, 1, 0));
}

TEST_CASE("plane: uv are right-handed, upright and in its own units") {
  const auto uv = [](const Shape& plane, const Vec3& at, const Vec3& from) {
    return surface_hit(plane, {at + from, -from}).uv;
  };
  const auto floor = make_plane({1, 0, 0}, {0, 1, 0});
  CHECK(uv(*floor, {3, 0, 5}, {0, 1, 0}) == Vec2(2, -5));
  const auto wall = make_plane({0, 0, 0}, {0, 0, 1});
  CHECK(uv(*wall, {3, 7, 0}, {0, 0, 1}) == Vec2(3, 7));
  const auto side = make_plane({0, 0, 0}, {-2, 0, 0});
  CHECK(uv(*side, {0, 7, 4}, {-1, 0, 0}) == Vec2(4, 7));
  const auto diagonal = make_plane({0, 0, 0}, {0, 1, 0}, Mat4(1.0), Vec3(1, 5, 1));
  CHECK(near(uv(*diagonal, {1, 0, 1}, {0, 1, 0}).x, std::sqrt(2.0), 1e-15));
  CHECK(near(uv(*diagonal, {1, 0, 1}, {0, 1, 0}).y, 0, 1e-15));

  // Scaled by 2 along x only: a point twice as far has the same u; moved: the origin moves along.
  const auto stretched =
      make_plane({1, 0, 0}, {0, 1, 0}, glm::scale(glm::translate(Mat4(1.0), Vec3(0, 4, 0)), Vec3(2, 1, 1)));
  CHECK(near(surface_hit(*stretched, {{6, 9, 5}, {0, -1, 0}}).position, Vec3(6, 4, 5), 1e-14));
  CHECK(uv(*stretched, {6, 4, 5}, {0, 1, 0}) == Vec2(2, -5));
}

TEST_CASE("a normal maps by the inverse transpose, and outside stays outside under a mirror") {
  const Mat4 stretch = glm::scale(Mat4(1.0), Vec3(1, 2, 1));
  const Vec3 expected = glm::normalize(Vec3(2, 1, 0));
  CHECK(near(surface_hit(*make_plane({0, 0, 0}, {1, 1, 0}, stretch), {{5, 5, 0}, {-1, -1, 0}}).normal,
             expected, 1e-15));
  const TriangleValues slope{.vertices = {Vec3(1, 0, -9), Vec3(0, 1, 0), Vec3(1, 0, 9)}};
  CHECK(
      near(surface_hit(*make_triangle(slope, stretch), {{5, 5, 0}, {-4.5, -4, 0}}).normal, expected, 1e-15));

  const Mat4 mirror = glm::scale(Mat4(1.0), Vec3(-1, 1, 1));
  const TriangleValues wall{.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
  const SurfacePoint point = surface_hit(*make_triangle(wall, mirror), {{-0.25, 0.5, 1}, {0, 0, -1}});
  CHECK(point.normal_geometric == Vec3(0, 0, 1));
  CHECK(near(point.uv.x, 0.25, 1e-15));
  CHECK(near(point.uv.y, 0.5, 1e-15));
}

TEST_CASE("triangle: attributes belong to their corners") {
  const Vec3 tilted = glm::normalize(Vec3(1, 0, 1));
  const TriangleValues values{.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0)},
                              .normals = {{Vec3(0, 0, 1), Vec3(5, 0, 5), Vec3(0, 0, 2)}},
                              .uv = {{Vec2(10, 20), Vec2(30, 20), Vec2(10, 60)}}};
  for (const bool mirrored : {false, true}) {
    const double side = mirrored ? -1 : 1;
    const auto triangle = make_triangle(values, glm::scale(Mat4(1.0), Vec3(side, 1, 1)));
    const SurfacePoint corner = surface_hit(*triangle, {{side * 2, 0, 3}, {0, 0, -1}});
    CHECK(near(corner.normal, tilted * Vec3(side, 1, 1), 1e-15));
    CHECK(corner.normal_geometric == Vec3(0, 0, 1));
    CHECK(corner.uv == Vec2(30, 20));
    const SurfacePoint inside = surface_hit(*triangle, {{side * 0.5, 1, 3}, {0, 0, -1}});
    CHECK(near(inside.uv.x, 15, 1e-13));
    CHECK(near(inside.uv.y, 40, 1e-13));
    CHECK(near(inside.position, Vec3(side * 0.5, 1, 0), 1e-15));
  }
  CHECK(distance(*make_triangle(values), {{1.001, 1.001, 3}, {0, 0, -1}}) == -1);
  CHECK(distance(*make_triangle(values), {{0.5, 0.5, 3}, {0, 0, 1}}) == -1);
  CHECK(distance(*make_triangle(values), {{0.5, 0.5, -3}, {0, 0, 2}}) == 1.5);
  CHECK(distance(*make_triangle(values), {{-1, 0.5, 0}, {1, 0, 0}}) == -1);
}

TEST_CASE("triangle: no ray passes between neighbours") {
  // A closed icosahedron, near and far, large and small; rays from its centre to its corners and along its
  // edges.
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> corners;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      corners.insert(corners.end(), {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)});
    }
  }
  Dice dice;
  int leaks = 0;
  for (int round = 0; round < 200; ++round) {
    const Vec3 center = dice.in_box(round % 2 ? 1e5 : 1);
    const Mat4 turn = glm::rotate(Mat4(1.0), dice.between(0, 6), dice.direction()) *
                      glm::scale(Mat4(1.0), Vec3(dice.scale(-2, 2)));
    std::vector<Vec3> mesh;
    for (const Vec3& corner : corners) mesh.push_back(center + Vec3(turn * glm::dvec4(corner, 0)));
    const double edge = glm::length(Vec3(turn * glm::dvec4(0, 2, 0, 0)));
    std::vector<std::unique_ptr<Shape>> faces;
    std::vector<std::pair<Vec3, Vec3>> edges;
    const auto adjacent = [&](size_t i, size_t j) {
      return near(glm::length(mesh[i] - mesh[j]), edge, 1e-3 * edge);
    };
    for (size_t i = 0; i < 12; ++i) {
      for (size_t j = i + 1; j < 12; ++j) {
        if (!adjacent(i, j)) continue;
        edges.emplace_back(mesh[i], mesh[j]);
        for (size_t k = j + 1; k < 12; ++k)
          if (adjacent(i, k) && adjacent(j, k))
            faces.push_back(make_triangle({.vertices = {mesh[i], mesh[j], mesh[k]}}));
      }
    }
    REQUIRE(edges.size() == 30);
    REQUIRE(faces.size() == 20);
    const auto leaks_towards = [&](const Vec3& target) {
      const Vec3 eye = center + dice.in_box(0.2 * edge);
      for (const auto& face : faces)
        if (face->intersect({eye, target - eye})) return false;
      return true;
    };
    for (const Vec3& corner : mesh)
      for (int i = 0; i < 10; ++i) leaks += leaks_towards(corner);
    for (const auto& [from, to] : edges)
      for (int i = 0; i < 20; ++i) leaks += leaks_towards(glm::mix(from, to, dice.between(0, 1)));
  }
  CHECK(leaks == 0);
}

TEST_CASE("polygon: concave and with a hole, from both sides; uv in its own units") {
  const PlanarRegion region{{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {2, 1, 0}, {0, 3, 0}},
                            {{{0.5, 0.5, 0}, {1, 0.5, 0}, {1, 1, 0}}}};
  const auto polygon = make_polygon(region);
  const auto down = [&](double x, double y) { return distance(*polygon, {{x, y, 5}, {0, 0, -1}}); };
  CHECK(down(2, 0.5) == 5);
  CHECK(down(3, 1.5) == 5);
  CHECK(down(2, 2) == -1);      // in the notch
  CHECK(down(0.9, 0.6) == -1);  // in the hole
  CHECK(down(0.6, 0.9) == 5);
  CHECK(down(-0.1, 1) == -1);
  CHECK(down(4.1, 1) == -1);
  CHECK(distance(*polygon, {{2, 0.5, -3}, {0, 0, 2}}) == 1.5);
  CHECK(distance(*polygon, {{2, 0.5, 5}, {0, 0, 1}}) == -1);
  CHECK(distance(*polygon, {{-1, 0.5, 0}, {1, 0, 0}}) == -1);
  CHECK(surface_hit(*polygon, {{3, 1, -5}, {0, 0, 1}}).normal == Vec3(0, 0, 1));
  CHECK(surface_hit(*polygon, {{3, 1, 5}, {0, 0, -1}}).uv == Vec2(3, 1));
  CHECK(surface_hit(*make_polygon(region, Mat4(1.0), Vec3(0, 2, 9)), {{3, 1, 5}, {0, 0, -1}}).uv ==
        Vec2(1, -3));

  const auto mirrored = make_polygon(region, glm::scale(Mat4(1.0), Vec3(-2, 1, 1)));
  const SurfacePoint point = surface_hit(*mirrored, {{-6, 1, 5}, {0, 0, -1}});
  CHECK(point.normal_geometric == Vec3(0, 0, 1));
  CHECK(point.uv == Vec2(3, 1));
}

TEST_CASE("parallelogram: its edges, its uv, a mirror") {
  const auto shape = make_parallelogram({1, 0, 0}, {2, 0, 0}, {0.5, 1, 0});
  CHECK(distance(*shape, {{2.25, 0.5, 4}, {0, 0, -2}}) == 2);
  CHECK(distance(*shape, {{1.1, 0.9, 4}, {0, 0, -2}}) == -1);
  CHECK(distance(*shape, {{3.4, 0.9, 4}, {0, 0, -2}}) == 2);
  CHECK(distance(*shape, {{3.2, 0.1, 4}, {0, 0, -2}}) == -1);
  const SurfacePoint point = surface_hit(*shape, {{2.375, 0.75, 4}, {0, 0, -2}});
  CHECK(near(point.uv.x, 0.5, 1e-15));
  CHECK(near(point.uv.y, 0.75, 1e-15));
  CHECK(point.normal == Vec3(0, 0, 1));
  const auto mirrored =
      make_parallelogram({1, 0, 0}, {2, 0, 0}, {0.5, 1, 0}, glm::scale(Mat4(1.0), Vec3(-1, 1, 1)));
  CHECK(surface_hit(*mirrored, {{-2.375, 0.75, 4}, {0, 0, -2}}).normal == Vec3(0, 0, 1));
}

TEST_CASE("prism: caps and walls, from outside, inside and through its notch") {
  const PlanarRegion region{{{0, 0, 0}, {3, 0, 0}, {3, 0, 2}, {2, 0, 2}, {2, 0, 1}, {0, 0, 1}}};
  const auto prism = make_prism(region, {0, 2, 0});
  const struct {
    Ray ray;
    double t;
    Vec3 normal;
    Vec2 uv;
  } hits[] = {{{{1, 5, 0.5}, {0, -1, 0}}, 3, {0, 1, 0}, {1, -0.5}},
              {{{1, -4, 0.5}, {0, 1, 0}}, 4, {0, -1, 0}, {-1, -0.5}},
              {{{-1, 1, 0.5}, {1, 0, 0}}, 1, {-1, 0, 0}, {0.5, 1}},
              {{{1, 1, 0.5}, {1, 0, 0}}, 2, {1, 0, 0}, {6.5, 1}},
              {{{1, 1, 0.5}, {0, 1, 0}}, 1, {0, 1, 0}, {1, -0.5}},
              {{{1, 0.5, 3}, {0, 0, -1}}, 2, {0, 0, 1}, {2, 0.5}},
              {{{-1, 1, 1.5}, {1, 0, 0}}, 3, {-1, 0, 0}, {3.5, 1}}};
  for (const auto& [ray, t, normal, uv] : hits) {
    CHECK(near(distance(*prism, ray), t, 1e-14));
    const SurfacePoint point = surface_hit(*prism, ray);
    CHECK(near(point.normal_geometric, normal, 1e-15));
    CHECK(near(point.uv.x, uv.x, 1e-14));
    CHECK(near(point.uv.y, uv.y, 1e-14));
  }
  CHECK(distance(*prism, {{1, 5, 1.5}, {0, -1, 0}}) == -1);
  CHECK(distance(*prism, {{-1, 3, 0.5}, {1, 0, 0}}) == -1);

  // If the outline is swept down, the body is below it, and outside stays outside: in a hole and under a
  // mirror too.
  const auto sunk = make_prism(region, {0, -2, 0}, glm::scale(Mat4(1.0), Vec3(-1, 1, 1)));
  CHECK(near(surface_hit(*sunk, {{-1, 5, 0.5}, {0, -1, 0}}).normal, Vec3(0, 1, 0), 1e-15));
  CHECK(near(distance(*sunk, {{-1, 5, 0.5}, {0, -1, 0}}), 5, 1e-14));
  CHECK(near(surface_hit(*sunk, {{1, -1, 0.5}, {-1, 0, 0}}).normal, Vec3(1, 0, 0), 1e-15));
  const PlanarRegion frame{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                           {{{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}}}};
  const auto oblique = make_prism(frame, {1, 0, 2});
  CHECK(distance(*oblique, {{2.5, 2, 5}, {0, 0, -1}}) == -1);
  const SurfacePoint within = surface_hit(*oblique, {{2.5, 2, 1}, {1, 0, 0}});
  CHECK(near(within.position, Vec3(3.5, 2, 1), 1e-14));
  CHECK(near(within.normal, glm::normalize(Vec3(-2, 0, 1)), 1e-14));
}
