// The march finds the first root along a ray: compared with float64 values at points close together.
#include <algorithm>
#include <cmath>

#include "tests/expression/evaluate.hpp"
#include "tests/expression/surfaces.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

constexpr int most_steps = 4096;

struct Count {
  int hits = 0, missed = 0, wrong = 0, grazing = 0, iteration_limit = 0, most = 0;
  double steps = 0, worst = 0;  // the worst distance of a root
};

// The first change of sign of f on o + t·d, 0 ≤ t ≤ end, or -1.
template <typename F>
double first_change(const F& f, const Vec3& o, const Vec3& d, double end) {
  constexpr int samples = 2000;
  double before = f(o);
  for (int i = 1; i <= samples; ++i) {
    const double t = end * i / samples;
    const double value = f(o + d * t);
    if ((before < 0) == (value < 0)) continue;
    double low = end * (i - 1) / samples, high = t;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      ((f(o + d * middle) < 0) == (before < 0) ? low : high) = middle;
    }
    return high;
  }
  return -1;
}

Vec3 gradient(double (*f)(const Vec3&), const Vec3& p) {
  constexpr double step = 1e-6;
  return Vec3(f(p + Vec3(step, 0, 0)) - f(p - Vec3(step, 0, 0)),
              f(p + Vec3(0, step, 0)) - f(p - Vec3(0, step, 0)),
              f(p + Vec3(0, 0, step)) - f(p - Vec3(0, 0, step))) /
         (2 * step);
}

Count march_often(const test::TestSurface& surface, int rays) {
  const expression::StraightLine function = test::straight_line(surface.glsl);
  Random random(11);
  Count count;
  for (int i = 0; i < rays; ++i) {
    const shader::vec3 o(random.point(surface.reach)), d(random.direction());
    const double end = surface.reach;
    const test::FirstRoot found =
        test::march(function, o, d, float(end), 4e-7f * float(surface.reach), most_steps);
    const double root = first_change(surface.f, Vec3(o), Vec3(d), end);
    count.steps += double(found.steps) / rays;
    count.most = std::max(count.most, found.steps);
    count.iteration_limit += !found.over;
    if (!found.over) continue;

    const auto noise = [&](double t) {
      return double(test::bound_piece(function, o, d, float(t), 1e-6f * float(surface.reach)).z);
    };
    // True if f returns to zero, from the root at t on, before it is farther from zero than float32 resolves.
    const auto undecidable = [&](double t) {
      const double again = first_change(surface.f, Vec3(o) + Vec3(d) * t, Vec3(d), end - t);
      double farthest = 0;
      for (int k = 1; k < 100 && again >= 0; ++k)
        farthest = std::max(farthest, std::abs(surface.f(Vec3(o) + Vec3(d) * (t + again * k / 100))));
      return again >= 0 && farthest <= 2 * noise(t);
    };
    const double slack = (surface.jumps ? 5e-4 : 1e-4) * surface.reach;
    const double t = double(found.t);
    if (root >= 0 && std::abs(t - root) <= slack) {
      ++count.hits;
      count.worst = std::max(count.worst, std::abs(t - root));
    } else if (t < 0 && root < 0) {
      continue;
    } else if (root >= 0 && (t < 0 || t > root)) {
      ++(undecidable(root) ? count.grazing : count.missed);
    } else {
      // The samples may have missed two roots between two of them, or a touch.
      ++(std::abs(surface.f(Vec3(o) + Vec3(d) * t)) <= 2 * noise(t) ? count.grazing : count.wrong);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("a march reaches its end, however short its finest piece is") {
  const expression::StraightLine one = test::straight_line("float f(vec3 p) { return p.x + 1.0; }");
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const float end = float(random.log_uniform(1e-3, 1e4));
    const float finest = end * float(random.log_uniform(1e-9, 1e-6));
    const test::FirstRoot found = test::march(one, {0, 0, 0}, {1, 0, 0}, end, finest, most_steps);
    INFO(end, " ", finest, " ", found.steps);
    REQUIRE(found.over);
  }
}

TEST_CASE("2 000 rays at each surface miss no root and find no false one") {
  for (const test::TestSurface& surface : test::test_surfaces()) {
    CAPTURE(surface.name);
    const Count count = march_often(surface, 2'000);
    MESSAGE(
        fmt::format("{:14} hits {:5}, grazing {:3}, missed {}, wrong {}, limits {}; steps {:5.1f}, at most "
                    "{}; off by {:.1e}",
                    surface.name, count.hits, count.grazing, count.missed, count.wrong, count.iteration_limit,
                    count.steps, count.most, count.worst));
    CHECK(count.hits > 100);
    CHECK(count.missed == 0);
    CHECK(count.wrong == 0);
    CHECK(count.iteration_limit <= 4);
  }
}

TEST_CASE("rays that skim the Mandelbulb hit it where f changes its sign, not wherever its bound allows") {
  // On this surface, a bound may be hundreds of times as wide as float32's rounding.
  const test::TestSurface& bulb =
      *std::ranges::find(test::test_surfaces(), "mandelbulb", &test::TestSurface::name);
  const expression::StraightLine function = test::straight_line(bulb.glsl);
  constexpr double before = 0.01;
  Random random(5);
  int rays = 0, from_behind = 0;
  double worst = 0;
  while (rays < 500) {
    const Vec3 start(random.point(bulb.reach)), toward(random.direction());
    const double at = bulb.f(start) > 0 ? first_change(bulb.f, start, toward, bulb.reach) : -1;
    if (at < 0) continue;
    const Vec3 p = start + toward * at, n = glm::normalize(gradient(bulb.f, p));
    const Vec3 along = glm::normalize(glm::cross(n, Vec3(random.direction())));
    const shader::vec3 d(glm::normalize(along - n * random.uniform(0.02, 0.1))), o(p - Vec3(d) * before);
    if (bulb.f(Vec3(o)) < 0 || first_change(bulb.f, Vec3(o), Vec3(d), 2 * before) < 0) continue;
    ++rays;
    const double t = double(test::march(function, o, d, float(2 * before), 3e-7f, most_steps).t);
    if (t < 0) continue;
    const Vec3 hit = Vec3(o) + Vec3(d) * t;
    const Vec3 slope = gradient(bulb.f, hit);
    worst = std::max(worst, std::abs(bulb.f(hit)) / glm::length(slope));
    from_behind += glm::dot(slope, Vec3(d)) > 0;
  }
  MESSAGE(fmt::format("off the surface by at most {:.1e}, {} from behind", worst, from_behind));
  CHECK(worst < 8e-6);
  CHECK(from_behind == 0);
}

TEST_CASE(
    "rays hit flakes of the Mandelbulb that float32 resolves, however much its bound allows for rounding") {
  const test::TestSurface& bulb =
      *std::ranges::find(test::test_surfaces(), "mandelbulb", &test::TestSurface::name);
  const expression::StraightLine function = test::straight_line(bulb.glsl);
  constexpr double before = 0.005;
  Random random(7);
  int rays = 0, missed = 0;
  while (rays < 500) {
    const Vec3 start(random.point(bulb.reach)), toward(random.direction());
    const double at = bulb.f(start) > 0 ? first_change(bulb.f, start, toward, bulb.reach) : -1;
    if (at < 0) continue;

    // A ray that is inside the surface over a short distance.
    const Vec3 p = start + toward * at, n = glm::normalize(gradient(bulb.f, p));
    const shader::vec3 d(glm::normalize(glm::cross(n, Vec3(random.direction()))));
    const shader::vec3 o(p - n * random.log_uniform(1e-6, 1e-4) - Vec3(d) * before);
    const auto f = [&](double t) { return bulb.f(Vec3(o) + Vec3(d) * t); };
    const double in = f(0) > 0 ? first_change(bulb.f, Vec3(o), Vec3(d), 2 * before) : -1;
    const double way = in > 0 ? first_change(bulb.f, Vec3(o) + Vec3(d) * in, Vec3(d), 2 * before - in) : -1;
    if (way < 0) continue;

    // The greatest depth on that distance, and the error of float32.
    double deepest = 0, rounding = 0;
    for (int k = 1; k < 32; ++k) {
      const float t = float(in + way * k / 32);
      deepest = std::max(deepest, -f(double(t)));
      rounding =
          std::max(rounding, std::abs(double(test::bound_piece(function, o, d, t, 0).x) - f(double(t))));
    }
    if (deepest < 16 * rounding) continue;
    ++rays;
    const double t = double(test::march(function, o, d, float(2 * before), 3e-7f, most_steps).t);
    missed += !(t > in - 1e-5 && t < in + way);
  }
  MESSAGE(fmt::format("{} of {} flakes missed", missed, rays));
  CHECK(missed <= 10);
}
