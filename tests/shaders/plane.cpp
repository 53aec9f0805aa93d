// plane.glsl: the hit lies on the plane, parallel rays miss, and rays that leave it do not hit it again.
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "host/core/parallel_for.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

shader::Primitive make_plane(const Vec3& normal, double d) {
  shader::Primitive plane{};
  plane.a = to_vec4(normal, d);
  return plane;
}

}  // namespace

TEST_CASE("2 million rays leave a plane at distances up to 1e4: none hits it again, every hit is on it") {
  std::atomic<int> rehits = 0;
  std::atomic<int> off = 0;
  std::atomic<int> left = 0;
  parallel_for(0, 64, [&](int part) {
    Random random{uint64_t(part)};
    for (int i = 0; i < 2'000'000 / 64; ++i) {
      const double scale = random.log_uniform(1e-4, 1e4);
      const Vec3 normal = random.below(4) == 0 ? Vec3(0, 1, 0) : random.direction();
      const shader::Primitive plane = make_plane(normal, random.uniform(-1, 1) * scale);
      const shader::Ray ray = shader::make_ray(glm::vec3(random.point(scale)), glm::vec3(random.direction()));
      shader::Hit hit{};
      hit.t = shader::plane_intersect(plane, ray, hit.uv);
      if (!(hit.t > 0) || hit.t > 1e6f * float(scale)) continue;
      ++left;
      const shader::Surface surface = shader::plane_surface(plane, ray, hit);
      const double height = glm::dot(Vec3(shader::plane_normal(plane)), Vec3(surface.p)) -
                            double(shader::plane_distance(plane));
      off += !(std::fabs(height) <= double(surface.offset));
      shader::vec2 uv{};
      const glm::vec3 away(random.direction());
      const double cosine = glm::dot(Vec3(away), Vec3(shader::plane_normal(plane)));
      if (std::fabs(cosine) < 1e-6) continue;  // the sign of n·d itself is lost in float32
      rehits += shader::plane_intersect(plane, shader::spawn_ray(surface, away), uv) > 0;
    }
  });
  MESSAGE(fmt::format("{} left, {} hits off the plane, {} re-hits", left.load(), off.load(), rehits.load()));
  CHECK(left > 500'000);
  CHECK(off == 0);
  CHECK(rehits == 0);
}

TEST_CASE("a ray parallel to a plane, in it or beside it, is a miss in trace()") {
  PackedScene scene;
  scene.primitives = {make_plane({0, 1, 0}, 0)};
  scene.primitives[0].material_and_kind = shader::material_and_kind(0, shader::KIND_plane);
  scene.materials.resize(1);  // without holes
  for (uint32_t kind = 0; kind < shader::SHAPE_KINDS; ++kind)
    scene.linear_ends.push_back(kind < shader::KIND_plane ? 0 : 1);
  const shader::Binding binding(twin::view_of(scene));
  for (const float height : {0.0f, -0.0f, 1.0f, -1.0f, 1e-30f}) {
    uint32_t flags = 0;
    const shader::Hit hit = shader::trace(shader::make_ray({0, height, 0}, {1, 0, 0}), flags);
    CHECK(hit.slot == NONE);
    CHECK(hit.t == T_MISS);
  }
}
