// kernels/cooperative/shaft.glsl: a shaft around rays hits every box that one of the rays hits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/twin/shader_functions.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

struct Box {
  Vec3 lower, upper;
};

// True if the ray hits the box before t_max, in float64.
bool meets(const shader::Ray& ray, double t_max, const Box& box) {
  double near = 0;
  double far = t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lower[axis] - double(ray.o[axis])) / double(ray.d[axis]);
    const double b = (box.upper[axis] - double(ray.o[axis])) / double(ray.d[axis]);
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

// Rays from about one point in about one direction, with one major axis; their spread is random.
std::vector<shader::Ray> bundle(Random& random, double scale) {
  const Vec3 start = random.point(2 * scale);
  const Vec3 direction = random.direction();
  const double spread = random.log_uniform(1e-6, 0.3);
  const double turn = random.below(4) == 0 ? 0 : spread;
  std::vector<shader::Ray> rays;
  while (rays.size() < 32) {
    const Vec3 d = glm::normalize(direction + random.point(1) * turn);
    const shader::Ray ray = shader::make_ray(glm::vec3(start + random.point(spread * scale)), glm::vec3(d));
    const bool alike =
        rays.empty() || (ray.major == rays[0].major &&
                         std::signbit(ray.d[int(ray.major)]) == std::signbit(rays[0].d[int(ray.major)]));
    if (alike) rays.push_back(ray);
  }
  return rays;
}

// The shaft around the rays up to t_max, as kernels/cooperative/packet.glsl makes it.
shader::Shaft around(const std::vector<shader::Ray>& rays, float t_max, float reach) {
  const uint32_t major = rays[0].major;
  const float forward = std::signbit(rays[0].d[int(major)]) ? -1.0f : 1.0f;
  const float slack = 0x1p-18f * reach;
  float z0 = T_MISS;
  float z1 = -T_MISS;
  for (const shader::Ray& ray : rays) {
    const float z = forward * ray.o[int(major)];
    z0 = std::min(z0, z - slack);
    z1 = std::max(z1, z + std::abs(ray.d[int(major)]) * t_max + slack);
  }
  shader::vec2 low0(T_MISS), low1(T_MISS), high0(-T_MISS), high1(-T_MISS);
  for (const shader::Ray& ray : rays) {
    const shader::vec3 p = shader::permute(ray.o, major);
    const shader::vec2 at0 = shader::vec2(p.x, p.y) + ray.shear * (forward * z0 - p.z);
    const shader::vec2 at1 = shader::vec2(p.x, p.y) + ray.shear * (forward * z1 - p.z);
    low0 = glm::min(low0, at0);
    low1 = glm::min(low1, at1);
    high0 = glm::max(high0, at0);
    high1 = glm::max(high1, at1);
  }
  return shader::make_shaft(major, forward * z0, forward * z1, low0, low1, high0, high1, slack);
}

}  // namespace

TEST_CASE("a shaft around 32 rays hits every box that a ray hits, and fewer than half of the others") {
  Random random(5);
  int met = 0;
  int missed = 0;
  int left_out = 0;
  int wrong = 0;
  for (int round = 0; round < 20'000; ++round) {
    const double scale = random.log_uniform(1e-3, 1e4);
    const std::vector<shader::Ray> rays = bundle(random, scale);
    const auto t_max = float(random.log_uniform(0.1, 10) * scale);
    const shader::Shaft shaft = around(rays, t_max, float(16 * scale));
    for (int i = 0; i < 20; ++i) {
      // A box around a point on a ray or beside the ray, sometimes flat.
      const shader::Ray& ray = rays[random.below(32)];
      const double size = random.log_uniform(1e-5, 1) * scale;
      const Vec3 middle =
          Vec3(ray.o) + Vec3(ray.d) * random.uniform(-0.2, 1.2) * double(t_max) + random.point(2 * size);
      const Vec3 half = glm::abs(random.point(size)) * Vec3(random.below(4) > 0, 1, 1);
      const glm::vec3 lower(middle - half);
      const glm::vec3 upper(middle + half);
      const bool any = std::ranges::any_of(
          rays, [&](const shader::Ray& r) { return meets(r, double(t_max), {Vec3(lower), Vec3(upper)}); });
      const bool by_shaft = shader::entry_of(shaft, lower, upper, FAR_AWAY) != FAR_AWAY;
      ++(any ? met : missed);
      wrong += any && !by_shaft;
      left_out += !any && !by_shaft;
    }
  }
  MESSAGE(fmt::format("{} boxes are hit, {} of them left out; {} are missed by all rays, {} left out", met,
                      wrong, missed, left_out));
  CHECK(wrong == 0);
  CHECK(met > 40'000);
  CHECK(2 * left_out > missed);
}
