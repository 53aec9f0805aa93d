// Packed scenes and rays for tests that look at kernels rather than at pictures.
#pragma once

#include "records/packer.hpp"
#include "support/random.hpp"

namespace eyeray::test {

// `count` primitives of each kind within a few units of the origin, with duplicates now and then, all of one
// opaque material.
inline PackedScene random_scene(Random& random, int count) {
  PackedScene scene;
  const auto head = [](uint32_t kind) { return shader::uvec4(kind, 0, SHADOW_OPAQUE, NONE); };
  for (int i = 0; i < count; ++i) {
    shader::Primitive sphere{};
    sphere.head = head(shader::KIND_sphere);
    sphere.a = to_vec4(random.point(3), random.log_uniform(0.01, 1));
    sphere.b = {0, 1, 0, 0};
    sphere.c = {1, 0, 0, 1};
    scene.primitives.push_back(i > 0 && random.below(8) == 0 ? scene.primitives.back() : sphere);
  }
  for (int i = 0; i < count; ++i) {
    shader::Primitive plane{};
    plane.head = head(shader::KIND_plane);
    plane.a = to_vec4(random.below(3) == 0 ? Vec3(0, 1, 0) : random.direction(), random.uniform(-9, -4));
    scene.primitives.push_back(plane);
  }
  for (int i = 0; i < count; ++i) {
    shader::Primitive triangle{};
    triangle.head = head(shader::KIND_triangle);
    const Vec3 a = random.point(3), b = a + random.point(1), c = a + random.point(1);
    const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
    triangle.a = to_vec4(a, n.x);
    triangle.b = to_vec4(b, n.y);
    triangle.c = to_vec4(c, n.z);
    scene.primitives.push_back(i > 0 && random.below(8) == 0 ? scene.primitives.back() : triangle);
  }
  scene.kind_first = {0, uint32_t(count), uint32_t(2 * count), uint32_t(3 * count)};
  scene.kind_first.resize(shader::SHAPE_KINDS + 1, uint32_t(3 * count));
  shader::Material material{};
  material.head.w = SHADOW_OPAQUE;
  scene.materials = {material};
  scene.textures = {shader::Texture{}};
  return scene;
}

// Rays from anywhere to anywhere, some along an axis.
inline shader::QueryRay random_ray(Random& random) {
  const Vec3 axes[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const Vec3 direction = random.below(10) == 0 ? axes[random.below(3)] : random.direction();
  return {to_vec4(random.point(4)), to_vec4(direction, random.uniform(0, 8))};
}

}  // namespace eyeray::test
