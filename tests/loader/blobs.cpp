// Blobs, which are made of implicit surfaces, against their definition.
#include <fmt/format.h>

#include <cmath>

#include "host/core/vec.hpp"
#include "tests/loader/walls.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The nearest hit of all shapes; infinity if there is none.
double first_hit(const Scene& scene, const Ray& ray, Vec3* normal = nullptr) {
  double nearest = HUGE_VAL;
  for (const auto& shape : scene.shapes) {
    const auto hit = shape->intersect(ray);
    if (!hit || hit->t >= nearest) continue;
    nearest = hit->t;
    if (normal) *normal = shape->surface(ray, *hit).normal;
  }
  return nearest;
}

// The least t from 0 to 20 at which `value` changes its sign, by small steps and bisection.
template <typename Value>
double march(const Ray& ray, const Value& value) {
  constexpr double step = 0.01;
  for (double t = 0; t < 20; t += step) {
    if (value(ray.o + ray.d * (t + step)) > 0) continue;
    double low = t, high = t + step;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (value(ray.o + ray.d * middle) > 0 ? low : high) = middle;
    }
    return low;
  }
  return HUGE_VAL;
}

// Rays from around towards the middle hit where the definition is, and their normals lead out of it.
template <typename Value>
void check_rays(const Scene& scene, const Value& value, double tolerance) {
  Random random{3};
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from = random.direction() * 6.0, to(random.uniform(-1.2, 1.2), random.uniform(-1, 1), 0);
    const Ray ray{from, glm::normalize(to - from)};
    Vec3 normal(0);
    const double expected = march(ray, value), found = first_hit(scene, ray, &normal);
    CAPTURE(i);
    // A ray that skims the surface may be on either side of it.
    if (std::isfinite(expected) != std::isfinite(found)) {
      const double t = std::isfinite(expected) ? expected : found;
      CHECK(std::fabs(value(ray.o + ray.d * (t + 1e-4))) < 1e-3);
      continue;
    }
    if (!std::isfinite(expected)) continue;
    ++hits;
    CHECK(std::fabs(expected - found) < tolerance);
    const Vec3 at = ray.o + ray.d * found;
    CHECK(value(at + normal * 1e-3) > value(at - normal * 1e-3));
  }
  CHECK(hits > 100);
}

}  // namespace

TEST_CASE("a blob is where the strengths of its parts add up to its threshold") {
  const Scene scene = parse_walls(
      "[[blob]]\nspheres = [[-0.7, 0, 0, 1.1, 1], [0.7, 0.2, 0, 1, 1.5], [0, 0.1, 0.8, 0.7, -0.9]]\n"
      "cylinders = [[-1, -0.5, 0, 1, -0.5, 0.2, 0.6, 1]]\nthreshold = 0.4\nmaterial = \"wall\"\n"
      "transform = [{ scale = 1.25 }]\n");
  const auto fall = [](double distance, double radius, double strength) {
    const double share = 1 - distance * distance / (radius * radius);
    return share > 0 ? strength * share * share : 0;
  };
  check_rays(
      scene,
      [&](const Vec3& world) {
        const Vec3 p = world / 1.25, a(-1, -0.5, 0), b(1, -0.5, 0.2);
        const double along = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        return 0.4 - fall(glm::length(p - Vec3(-0.7, 0, 0)), 1.1, 1) -
               fall(glm::length(p - Vec3(0.7, 0.2, 0)), 1, 1.5) -
               fall(glm::length(p - Vec3(0, 0.1, 0.8)), 0.7, -0.9) -
               fall(glm::length(p - glm::mix(a, b, along)), 0.6, 1);
      },
      1e-5);
}

TEST_CASE("faulty blobs are refused") {
  const auto why = [](const std::string& text) { return refused(text + "material = \"wall\"\n"); };
  CHECK(why("[[blob]]\nspheres = [[0, 0, 0, 1, 0.3]]\n").find("the blob is empty") != std::string::npos);
  CHECK(why("[[blob]]\nspheres = [[0, 0, 0, 1]]\n").find("a list of rows [[x, y, z, radius, strength], …]") !=
        std::string::npos);
  CHECK(why("[[blob]]\nspheres = [[0, 0, 0, -1, 1]]\n").find("a radius must be from 1e-12 up") !=
        std::string::npos);
}

TEST_CASE("a blob that is empty everywhere gets a warning, and no other one does") {
  const auto warnings = [](const std::string& text) {
    std::string all;
    for (const Diagnostic& each : parse_walls(text + "material = \"wall\"\n").warnings)
      if (each.message.starts_with("the blob"))
        all += fmt::format("{}:{} {}\n", each.position.line, each.position.column, each.message);
    return all;
  };
  const std::string apart = "[[blob]]\nspheres = [[-2, 0, 0, 1, 1], [2, 0, 0, 1, 1]]\n";
  const std::string found = warnings(apart + "threshold = 1.2\n");
  CHECK(found.find(
            ":13 the blob is empty: at no point do its strengths add up to more than the threshold 1.2; ") !=
        std::string::npos);
  CHECK(warnings(apart + "threshold = 0.99\n").empty());
  // Parts that touch reach it between them.
  CHECK(warnings("[[blob]]\nspheres = [[-0.3, 0, 0, 1, 1], [0.3, 0, 0, 1, 1]]\nthreshold = 1.2\n").empty());
  CHECK(!warnings("[[blob]]\nspheres = [[-0.6, 0, 0, 1, 1], [0.6, 0, 0, 1, 1]]\nthreshold = 1.2\n").empty());
  // A dent may leave nothing.
  CHECK(!warnings("[[blob]]\nspheres = [[0, 0, 0, 1, 1], [0, 0, 0, 2, -0.9]]\n").empty());
  CHECK(warnings("[[blob]]\nspheres = [[0, 0, 0, 1, 1], [0.5, 0, 0, 0.7, -0.9]]\n").empty());
  CHECK(!warnings("[[blob]]\ncylinders = [[-1, 0, 0, 1, 0, 0, 0.5, 0.7], [-1, 3, 0, 1, 3, 0, 0.5, 0.7]]\n"
                  "threshold = 0.8\n")
             .empty());
}
