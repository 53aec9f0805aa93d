// Lathes, against closed shapes that they form.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "host/shapes/make.hpp"
#include "tests/loader/walls.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("a lathe along a straight line is a cone, and along parabolas a paraboloid") {
  const auto lathe = [](const std::string& spline, const std::string& points) {
    return parse_walls("[[lathe]]\nspline = \"" + spline + "\"\npoints = " + points +
                       "\nmaterial = \"wall\"\n");
  };
  struct Case {
    Scene scene;
    std::unique_ptr<Shape> expected;
  };
  std::vector<Case> cases;
  cases.push_back(
      {lathe("linear", "[[0.9, -1], [0.4, 1]]"), shapes::make_cone({0, -1, 0}, {0, 1, 0}, 0.9, 0.4, true)});
  // y = r² − 1 between the heights 0 … 3, and 0 … 1 for Catmull and Rom's spline.
  cases.push_back({lathe("quadratic", "[[0, -1], [1, 0], [2, 3]]"),
                   shapes::make_paraboloid({0, -1, 0}, {0, 3, 0}, 2, true)});
  cases.push_back({lathe("cubic", "[[-0.5, -0.75], [0, -1], [0.5, -0.75], [1, 0], [1.5, 1.25]]"),
                   shapes::make_paraboloid({0, -1, 0}, {0, 0, 0}, 1, true)});
  cases.push_back(
      {lathe("bezier", "[[0, -1], [0.333333333333, -1], [0.666666666667, -0.666666666667], [1, 0]]"),
       shapes::make_paraboloid({0, -1, 0}, {0, 0, 0}, 1, true)});
  for (size_t number = 0; number < cases.size(); ++number) {
    CAPTURE(number);
    const auto& [scene, expected] = cases[number];
    REQUIRE(scene.shapes.size() == 1);
    const Shape& found = *scene.shapes[0];
    const double lowest = number == 1 ? 0 : -1;  // the quadratic spline begins at its second point
    Random random{9};
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 from = random.direction() * 6.0;
      const Ray ray{
          from,
          glm::normalize(Vec3(random.uniform(-1, 1), random.uniform(-1, 2), random.uniform(-1, 1)) - from)};
      const auto wanted = expected->intersect(ray), hit = found.intersect(ray);
      if (!wanted || !hit) continue;
      const SurfacePoint a = expected->surface(ray, *wanted), b = found.surface(ray, *hit);
      // A ray that grazes one of them, or passes a rim, may hit the other behind it.
      if (a.position.y < lowest + 0.01 || std::fabs(glm::dot(a.normal, ray.d)) < 0.05) continue;
      ++hits;
      CAPTURE(i);
      CHECK(glm::length(a.position - b.position) < 2e-4);
      CHECK(std::fabs(glm::dot(a.normal, b.normal)) > 1 - 1e-6);
      const double turn = std::fabs(a.uv.x - b.uv.x);
      CHECK(std::min(turn, 1 - turn) < 2e-4);
    }
    CHECK(hits > 40);
  }
}

TEST_CASE("a lathe's normal points to the right of its curve") {
  const auto normal_of = [](const std::string& points) {
    const Scene scene = parse_walls("[[lathe]]\npoints = " + points + "\nmaterial = \"wall\"\n");
    const Ray ray{{5, 0.5, 0}, {-1, 0, 0}};
    const auto hit = scene.shapes[0]->intersect(ray);
    REQUIRE(hit);
    return scene.shapes[0]->surface(ray, *hit).normal_geometric.x;
  };
  CHECK(normal_of("[[1, 0], [1, 1]]") == doctest::Approx(1));
  CHECK(normal_of("[[1, 1], [1, 0]]") == doctest::Approx(-1));
}

TEST_CASE("faulty lathes are refused") {
  const auto has = [](const std::string& text, const std::string& reason) {
    const std::string found = refused(text + "\nmaterial = \"wall\"\n");
    CAPTURE(found);
    CHECK(found.find(reason) != std::string::npos);
  };
  has("[[lathe]]\npoints = [[1, 0]]", "a linear spline needs 2 points or more, not 1");
  has("[[lathe]]\nspline = \"bezier\"\npoints = [[1, 0], [1, 1], [1, 2], [1, 3], [1, 4]]",
      "a bezier spline needs 4 points for each segment, not 5");
  has("[[lathe]]\npoints = [[1, 0], [-1, 1]]", "the curve crosses the axis");
  has("[[lathe]]\npoints = [[0, 0], [0, 1]]", "the lathe has no surface");
  has("[[lathe]]\npoints = [[1e-9, 0], [1e-9, 1]]", "too thin");
}
