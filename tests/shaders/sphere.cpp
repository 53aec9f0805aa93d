// sphere.glsl against float64: hits and misses at every distance, the surface, and rays that leave it.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "host/core/parallel_for.hpp"
#include "host/records/packer.hpp"
#include "host/twin/shader_functions.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

constexpr int parts = 64;

shader::Primitive make_sphere(const Vec3& centre, double radius) {
  shader::Primitive sphere{};
  sphere.a = to_vec4(centre, radius);
  sphere.b = {0, 1, 0, 0};
  sphere.c = {1, 0, 0, 1};
  return sphere;
}

// The distance of the ray's line from the centre, divided by the radius, and the nearest t > 0: in float64,
// from the float32 inputs.
struct Exact {
  double ray_offset;
  double t;
};
Exact exact_hit(const shader::Primitive& sphere, const shader::Ray& ray) {
  const Vec3 f = Vec3(ray.o) - Vec3(shader::sphere_center(sphere));
  const Vec3 d(ray.d);
  const double a = glm::dot(d, d);
  const double b = -glm::dot(f, d);
  const Vec3 nearest = f + d * (b / a);
  const double r = double(shader::sphere_radius(sphere));
  const double square = glm::dot(nearest, nearest);
  const double root = std::sqrt(std::max(0.0, a * (r * r - square)));
  const double q = b < 0 ? b - root : b + root;
  const double c = (glm::length(f) - r) * (glm::length(f) + r);
  const double low = std::min(c / q, q / a);
  return {std::sqrt(square) / r, low > 0 ? low : std::max(c / q, q / a)};
}

}  // namespace

TEST_CASE("rays at a unit sphere are wrong only at the very rim, whatever the distance") {
  for (const double distance : {1.5, 1e1, 1e2, 1e3, 1e4}) {
    std::atomic<int> wrong = 0;
    std::atomic<int> hits = 0;
    std::atomic<int> rim = 0;
    std::atomic<double> error_sum = 0;
    parallel_for(0, parts, [&](int part) {
      Random random{uint64_t(part)};
      double sum = 0;
      for (int i = 0; i < 1'000'000 / parts; ++i) {
        const Vec3 centre = random.point(1);
        const Vec3 origin = centre + random.direction() * distance;
        const shader::Primitive sphere = make_sphere(centre, 1);
        const Vec3 aim = centre + random.point(1.2) - origin;
        const shader::Ray ray = shader::make_ray(glm::vec3(origin), glm::vec3(glm::normalize(aim)));
        const Exact exact = exact_hit(sphere, ray);
        shader::vec2 uv{};
        const float t = shader::sphere_intersect(sphere, ray, uv);
        const bool hit = t > 0;
        if (hit != (exact.ray_offset < 1 && exact.t > 0)) {
          // If the line passes this close to the rim, in radii, float32 cannot decide.
          (std::fabs(exact.ray_offset - 1) < 4e-7 * distance ? rim : wrong) += 1;
          continue;
        }
        if (!hit) continue;
        ++hits;
        shader::Hit record{};
        record.t = t;
        const shader::Surface surface = shader::sphere_surface(sphere, ray, record);
        sum += std::fabs(glm::length(Vec3(surface.p) - Vec3(shader::sphere_center(sphere))) - 1);
      }
      error_sum += sum;
    });
    MESSAGE(fmt::format(
        "distance {:>7g}: {} hits, {} wrong, {} undecidable at the rim, mean surface error {:.1e}", distance,
        hits.load(), wrong.load(), rim.load(), error_sum / hits));
    CHECK(hits > 100'000);
    CHECK(wrong == 0);
    CHECK(rim < 1000);
    CHECK(error_sum / hits < 2e-7);
  }
}

TEST_CASE("2 million rays leave a sphere, radius 1e-4 to 1e4: none hits it again or misses its far side") {
  std::atomic<int> first_misses = 0;
  std::atomic<int> rehits = 0;
  std::atomic<int> lost = 0;
  std::atomic<int> left = 0;
  parallel_for(0, parts, [&](int part) {
    Random random{uint64_t(part) + 1000};
    for (int i = 0; i < 2'000'000 / parts; ++i) {
      const double radius = random.log_uniform(1e-4, 1e4);
      const Vec3 centre = random.point(10 * radius);
      const shader::Primitive sphere = make_sphere(centre, radius);
      const Vec3 origin = random.point(30 * radius);
      const Vec3 target = centre + random.direction() * radius * 0.999;
      const shader::Ray ray = shader::make_ray(glm::vec3(origin), glm::vec3(glm::normalize(target - origin)));
      shader::Hit hit{};
      hit.t = shader::sphere_intersect(sphere, ray, hit.uv);
      if (!(hit.t > 0)) {
        ++first_misses;
        continue;
      }
      ++left;
      const shader::Surface surface = shader::sphere_surface(sphere, ray, hit);
      const shader::Ray away = shader::spawn_ray(surface, glm::vec3(random.direction()));
      const float t = shader::sphere_intersect(sphere, away, hit.uv);
      if (shader::dot3(away.d, surface.normal_geometric) > 0) {
        rehits += t > 0;
      } else {
        const Exact exact = exact_hit(sphere, away);
        lost += !(t > 0) || std::fabs(double(t) - exact.t) > 1e-3 * radius;
      }
    }
  });
  MESSAGE(fmt::format("{} left, {} first-hit misses, {} re-hits, {} lost inside", left.load(),
                      first_misses.load(), rehits.load(), lost.load()));
  CHECK(first_misses <= 20);
  CHECK(rehits == 0);
  CHECK(lost == 0);
}

TEST_CASE("a sphere smaller than the rounding of its distance still has a normal") {
  const shader::Primitive sphere = make_sphere({0, 0, -6}, 1e-12);
  const shader::Ray ray = shader::make_ray({0, 0, 0}, {0, 0, -1});
  shader::Hit hit{};
  hit.t = shader::sphere_intersect(sphere, ray, hit.uv);
  REQUIRE(hit.t == 6);
  const shader::Surface surface = shader::sphere_surface(sphere, ray, hit);
  CHECK(surface.normal == glm::vec3(0, 0, 1));
  CHECK(surface.p == glm::vec3(0, 0, -6));
}
