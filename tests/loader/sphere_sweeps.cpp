// Sphere sweeps, which are made of implicit surfaces, against the union of their balls.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "host/formula/formula.hpp"
#include "host/scene/shape.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/spline.hpp"
#include "tests/loader/walls.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

using Balls = std::vector<Vec4>;

Scene sweep(const std::string& spline, const Balls& points) {
  std::vector<std::string> rows;
  for (const Vec4& p : points) rows.push_back(fmt::format("[{}, {}, {}, {}]", p.x, p.y, p.z, p.w));
  return parse_walls(fmt::format("[[sphere_sweep]]\nspline = \"{}\"\npoints = [{}]\nmaterial = \"wall\"\n",
                                 spline, fmt::join(rows, ", ")));
}

// The distance from the nearest of very many balls along the curves; the nearest of them are searched by
// golden sections.
double distance_to(const std::vector<shapes::CubicCurve>& curves, const Vec3& p) {
  constexpr int samples = 1000;
  double least = HUGE_VAL;
  for (const shapes::CubicCurve& curve : curves) {
    const auto gap = [&](double t) {
      const Vec4 ball = curve.at(t);
      return glm::length(p - Vec3(ball)) - ball.w;
    };
    std::vector<double> gaps;
    for (int i = 0; i <= samples; ++i) gaps.push_back(gap(double(i) / samples));
    for (int i = 0; i <= samples; ++i) {
      const int before = std::max(i - 1, 0), after = std::min(i + 1, samples);
      least = std::min(least, gaps[size_t(i)]);
      if (gaps[size_t(i)] > least + 0.01 || gaps[size_t(i)] > gaps[size_t(before)] ||
          gaps[size_t(i)] > gaps[size_t(after)])
        continue;
      double low = double(before) / samples, high = double(after) / samples;
      for (int k = 0; k < 60; ++k) {
        const double third = (high - low) * 0.381966011250105;
        if (gap(low + third) < gap(high - third))
          high -= third;
        else
          low += third;
      }
      least = std::min(least, gap(0.5 * (low + high)));
    }
  }
  return least;
}

// The space of a sweep's formula, in which the longest side of the box is 2 · 1.001.
struct Space {
  Vec3 center;
  double scale;
  Vec3 into(const Vec3& p) const { return (p - center) / scale; }
};
Space space_of(const Shape& shape) {
  const Bounds box = shape.bounds();
  const Vec3 half = (box.max - box.min) * 0.5;
  return {(box.min + box.max) * 0.5, std::max({half.x, half.y, half.z}) / 1.001};
}

// The largest errors of the distance: inside and within 0.05 of the surface, farther outside as a share of
// the distance, and of float32 near the surface.
struct Errors {
  double near = 0, share = 0, single = 0;
  int wrong = 0;  // points with an error above 1e-5, inside and near the surface
};
Errors errors_of(const std::string& spline, const Balls& points, Random& random) {
  const Scene scene = sweep(spline, points);
  const Shape& shape = *scene.shapes[0];
  const Space space = space_of(shape);
  const auto curves = shapes::spline_curves(*shapes::find_spline(spline), points);
  const formula::Formula& formula = *shape.formula_use()->formula;
  Errors errors;
  for (int i = 0; i < 300; ++i) {
    const Vec4 ball = curves[size_t(random.uniform(0, double(curves.size())))].at(random.uniform(0, 1));
    const Vec3 out = random.direction() * std::max(ball.w + random.uniform(-ball.w, 0.05), 0.0);
    const Vec3 anywhere(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    const Vec3 at = i % 2 == 0 ? Vec3(ball) + out : anywhere, p = space.into(at);
    const double expected = distance_to(curves, at);
    const double error = std::fabs(formula.value(std::array{p.x, p.y, p.z}) * space.scale - expected);
    if (expected > 0.05) errors.share = std::max(errors.share, error / expected);
    if (expected > 0.05) continue;
    errors.near = std::max(errors.near, error);
    errors.wrong += error > 1e-5;
    const float found = formula.value(std::array{float(p.x), float(p.y), float(p.z)});
    errors.single = std::max(errors.single, std::fabs(double(found) * space.scale - expected));
  }
  return errors;
}

const Balls hook = {{-1, -1, 0, 0.3},     {-1, 0, 0, 0.1},   {-1, 0.5, 0, 0.2}, {-1, 0.8, 0.1, 0.15},
                    {-1, 0.8, 0.1, 0.15}, {-1, 1.5, 0, 0.1}, {0, 1.5, 0, 0.1},  {-0.2, 0.6, 0, 0}};
const Balls horn = {{-1, -1, 0, 0.3},     {-1, -1, 0, 0.3},   {0, -1.2, 0.5, 0.25}, {1, -0.8, 0.2, 0.2},
                    {1.2, 0, -0.2, 0.14}, {0.5, 0.7, 0, 0.1}, {0, 0.3, 0.3, 0.05},  {0.2, 0, 0.2, 0.01}};

}  // namespace

TEST_CASE("a sphere sweep's function is the distance from the nearest ball of its curve") {
  Random random{5};
  for (const std::string spline : {"linear", "cubic", "b_spline", "bezier"}) {
    CAPTURE(spline);
    const Errors errors = errors_of(spline, spline == "bezier" ? hook : horn, random);
    MESSAGE(spline << ": " << errors.near << ", in float32 " << errors.single << ", far off by a share of "
                   << errors.share);
    CHECK(errors.near < 2e-7);
    CHECK(errors.share < 0.02);
    CHECK(errors.single < 1e-6);
  }
}

TEST_CASE("the distance from a sphere sweep is right at random curves that cross themselves") {
  Random random{6};
  Errors most;
  for (int i = 0; i < 24; ++i) {
    Balls points;
    for (int k = 0; k < 6; ++k)
      points.emplace_back(random.direction() * random.uniform(0.3, 1.2), random.uniform(0.02, 0.2));
    CAPTURE(i);
    const Errors errors = errors_of(i % 2 == 0 ? "cubic" : "b_spline", points, random);
    CHECK(errors.near < 5e-3);  // a ball as wide as its bend
    CHECK(errors.share < 0.1);
    most.wrong += errors.wrong;
    most.near = std::max(most.near, errors.near);
    most.share = std::max(most.share, errors.share);
    most.single = std::max(most.single, errors.single);
  }
  CHECK(most.wrong <= 5);
  MESSAGE(most.wrong << " wrong, " << most.near << ", in float32 " << most.single
                     << ", far off by a share of " << most.share);
}

TEST_CASE("a straight sphere sweep is a capsule") {
  const double fourth = 0.25;
  struct Case {
    std::string spline;
    Balls points;
    double to_radius;
  };
  const std::vector<Case> cases = {
      {"linear", {{-1, 0, 0, 0.5}, {1, 0.5, 0, 0.5}}, 0.5},
      {"linear", {{-1, 0, 0, 0.5}, {0, fourth, 0, 0.375}, {1, 0.5, 0, fourth}}, fourth},
      {"bezier", {{-1, 0, 0, 0.5}, {-1, 0, 0, 0.5}, {1, 0.5, 0, fourth}, {1, 0.5, 0, fourth}}, fourth},
      {"cubic", {{-3, -0.5, 0, 0.5}, {-1, 0, 0, 0.5}, {1, 0.5, 0, 0.5}, {3, 1, 0, 0.5}}, 0.5},
  };
  for (size_t number = 0; number < cases.size(); ++number) {
    CAPTURE(number);
    const Scene scene = sweep(cases[number].spline, cases[number].points);
    const Scene expected =
        parse_walls(fmt::format("[[capsule]]\nfrom = [-1, 0, 0]\nto = [1, 0.5, 0]\nradius = 0.5\nto_radius = "
                                "{}\nmaterial = \"wall\"\n",
                                cases[number].to_radius));
    Random random{4};
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 from = random.direction() * 5.0;
      const Ray ray{from, glm::normalize(random.direction() * random.uniform(0, 1) - from)};
      const auto wanted = expected.shapes[0]->intersect(ray), found = scene.shapes[0]->intersect(ray);
      CAPTURE(i);
      CHECK(wanted.has_value() == found.has_value());
      if (!wanted || !found) continue;
      ++hits;
      const SurfacePoint a = expected.shapes[0]->surface(ray, *wanted),
                         b = scene.shapes[0]->surface(ray, *found);
      CHECK(glm::length(a.position - b.position) < 1e-6);
      CHECK(glm::dot(a.normal, b.normal) > 1 - 1e-6);
    }
    CHECK(hits > 100);
  }
}

TEST_CASE("the box of a sphere sweep is close around its balls") {
  const Scene scene = sweep("cubic", horn);
  const Bounds box = scene.shapes[0]->bounds();
  Bounds balls{Vec3(HUGE_VAL), Vec3(-HUGE_VAL)};
  for (const shapes::CubicCurve& curve : shapes::spline_curves(*shapes::find_spline("cubic"), horn))
    for (int i = 0; i <= 1000; ++i) {
      const Vec4 ball = curve.at(i / 1000.0);
      balls.include(Vec3(ball) - ball.w);
      balls.include(Vec3(ball) + ball.w);
    }
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(box.min[axis] < balls.min[axis]);
    CHECK(box.max[axis] > balls.max[axis]);
    CHECK(box.min[axis] > balls.min[axis] - 0.01);
    CHECK(box.max[axis] < balls.max[axis] + 0.01);
  }
}

TEST_CASE("faulty sphere sweeps are refused") {
  const auto has = [](const std::string& text, const std::string& reason) {
    const std::string found = refused("[[sphere_sweep]]\n" + text + "\nmaterial = \"wall\"\n");
    CAPTURE(found);
    CHECK(found.find(reason) != std::string::npos);
  };
  has("points = [[0, 0, 0, 1]]", "a linear spline needs 2 points or more, not 1");
  has("spline = \"cubic\"\npoints = [[0, 0, 0, 1], [1, 0, 0, 1]]",
      "a cubic spline needs 4 points or more, not 2");
  has("spline = \"bezier\"\npoints = [[0, 0, 0, 1], [1, 0, 0, 1], [1, 1, 0, 1], [1, 1, 1, 1], [2, 1, 1, 1]]",
      "a bezier spline needs 4 points for each segment, not 5");
  has("points = [[0, 0, 0, 1], [1, 0, 0, -1]]", "scene.toml:5:25: error: a radius must be 0 or more");
  has("points = [[0, 0, 0], [1, 0, 0]]", "a list of rows [[x, y, z, radius], …]");
  has("points = [[0, 0, 0, 0], [1, 0, 0, 0]]", "the sphere sweep is too thin");
  has("points = [[0, 0, 0, 1e-6], [1, 0, 0, 1e-6]]", "the sphere sweep is too thin");
  std::string many;
  for (int i = 0; i < 34; ++i) many += fmt::format("[{}, {}, 0, 0.1], ", i, i % 2);
  has("points = [" + many + "]", "a sphere sweep has at most 32 pieces, and this one has 33");
}
