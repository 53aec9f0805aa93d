// Gradients of texture coordinates on every shape: the shaders' gradients against the float64 half's
// derivatives, and those against the surface itself at a small displacement.
#include <cmath>

#include "host/shapes/registry.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "makers.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;
using test::Random;

namespace {

struct Counts {
  int looked_at = 0;
  int wrong_derivatives = 0;
  int wrong_gradients = 0;
};

// True if a step of the surface follows from its derivatives and the step in uv.
bool follows(const SurfacePoint& point, const SurfacePoint& neighbour) {
  const Vec3 step = neighbour.position - point.position;
  const Vec2 uv = neighbour.uv - point.uv;
  return glm::length(step - uv.x * point.along_u - uv.y * point.along_v) < 0.02 * glm::length(step);
}

bool agree(const shader::Surface& surface, const SurfacePoint& point) {
  const auto in_plane = [&](const Vec3& gradient) {
    return gradient - point.normal_geometric * glm::dot(gradient, point.normal_geometric);
  };
  const Vec3 u = in_plane(Vec3(surface.u_gradient)), v = in_plane(Vec3(surface.v_gradient));
  // The errors as shares of each derivative's size.
  const double u_size = glm::length(u) * glm::length(point.along_u),
               v_size = glm::length(v) * glm::length(point.along_v);
  const double crossed = std::max(u_size, v_size);
  return std::abs(glm::dot(u, point.along_u) - 1) < 2e-3 * u_size &&
         std::abs(glm::dot(v, point.along_v) - 1) < 2e-3 * v_size &&
         std::abs(glm::dot(u, point.along_v)) * glm::length(point.along_u) <
             2e-3 * crossed * glm::length(point.along_v) &&
         std::abs(glm::dot(v, point.along_u)) * glm::length(point.along_v) <
             2e-3 * crossed * glm::length(point.along_u);
}

shader::Surface surface_of(const PackedScene& scene, const shader::Ray& ray, uint32_t kind) {
  shader::Hit hit{};
  hit.t = T_MISS;
  for (uint32_t slot = 0; slot < scene.primitives.size(); ++slot) {
    shader::vec2 uv{};
    float t = -1;
#define INTERSECT(name, number) \
  if (kind == number) t = shader::name##_intersect(scene.primitives[slot], ray, uv);
    SHAPES(INTERSECT)
    if (!(t > 0) || !(t < hit.t)) continue;
    hit.t = t;
    hit.slot = slot;
    hit.uv = uv;
  }
#define SURFACE(name, number) \
  if (kind == number && hit.t < T_MISS) return shader::name##_surface(scene.primitives[hit.slot], ray, hit);
  SHAPES(SURFACE)
  return shader::no_surface();
}

void look(const Shape& shape, const PackedScene& scene, const Ray& ray, double size, Counts& counts) {
  const auto hit = shape.intersect(ray),
             neighbour = shape.intersect({ray.o + Vec3(1e-6, 2e-6, -1e-6) * size, ray.d});
  if (!hit || hit->iteration_limit || !neighbour || neighbour->iteration_limit) return;
  const SurfacePoint point = shape.surface(ray, *hit);
  if (std::abs(glm::dot(point.normal_geometric, ray.d)) < 0.1) return;
  const SurfacePoint beside = shape.surface({ray.o + Vec3(1e-6, 2e-6, -1e-6) * size, ray.d}, *neighbour);
  // A point beyond an edge or beyond the seam proves nothing.
  if (glm::length(beside.position - point.position) > 1e-4 * size ||
      glm::length(beside.uv - point.uv) > 0.1 ||
      glm::dot(beside.normal_geometric, point.normal_geometric) < 0.999)
    return;
  ++counts.looked_at;
  counts.wrong_derivatives += !follows(point, beside);
  const auto surface =
      surface_of(scene, shader::make_ray(glm::vec3(ray.o), glm::vec3(ray.d)), kind_of(scene.primitives[0]));
  if (glm::length(Vec3(surface.p) - point.position) < 1e-3 * size)
    counts.wrong_gradients += !agree(surface, point);
}

}  // namespace

TEST_CASE("derivatives of u and v agree in both halves on every shape") {
  for (const auto& maker : test::shape_makers()) {
    const auto& name = maker.first;
    const auto& make = maker.second;
    if (name.starts_with("points")) continue;  // they have no uv
    CAPTURE(name);
    Random random{7};
    Counts counts;
    for (int i = 0; i < 40; ++i) {
      const double size = random.log_uniform(0.01, 100);
      const auto shape = make(random, size);
      Packer packer(Vec3(0));
      packer.scene.bent_normals = true;
      shape->pack(packer);
      const shader::Binding binding(twin::view_of(packer.scene));
      const Bounds bounds = shape->bounds();
      const Vec3 center = (bounds.min + bounds.max) * 0.5, half = (bounds.max - bounds.min) * 0.5;
      for (int k = 0; k < 30; ++k) {
        const bool bounded = std::isfinite(half.x);
        const Vec3 target = bounded ? center + half * (2.0 * Vec3(random.uniform(0, 1), random.uniform(0, 1),
                                                                  random.uniform(0, 1)) -
                                                       1.0)
                                    : random.point(size);
        const Vec3 from = (bounded ? center : Vec3(0)) + 4 * size * random.direction();
        look(*shape, packer.scene, {from, glm::normalize(target - from)}, size, counts);
      }
    }
    CAPTURE(counts.looked_at);
    CHECK(counts.looked_at > 100);
    CAPTURE(counts.wrong_derivatives);
    CHECK(counts.wrong_derivatives <= counts.looked_at / 50);
    CAPTURE(counts.wrong_gradients);
    CHECK(counts.wrong_gradients <= counts.looked_at / 50);
  }
}
