// Scenes and rays for tests of kernels rather than of pictures.
#pragma once

#include "host/pack/pack.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"

namespace eyeray::engine::test {

// `count` primitives of each kind within a few units of the eye, at the origin, with duplicates now and then,
// all of one opaque material.
inline Scene random_scene(Random& random, int count) {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0);
  scene.camera.target = Vec3(0, 0, -1);
  const int material = add(scene, materials::make_phong({}));
  Vec3 center(0);
  double radius = 1;
  for (int i = 0; i < count; ++i) {
    if (i == 0 || random.below(8) > 0) {
      center = random.point(3);
      radius = random.log_uniform(0.01, 1);
    }
    add(scene, shapes::make_sphere(center, radius), material);
  }
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = random.below(3) == 0 ? Vec3(0, 1, 0) : random.direction();
    add(scene, shapes::make_plane(normal * random.uniform(-9, -4), normal), material);
  }
  shapes::TriangleValues triangle;
  for (int i = 0; i < count; ++i) {
    if (i == 0 || random.below(8) > 0) {
      const Vec3 a = random.point(3);
      triangle.vertices = {a, a + random.point(1), a + random.point(1)};
    }
    add(scene, shapes::make_triangle(triangle), material);
  }
  return scene;
}

// The scene as records.
inline records::PackedScene random_packed_scene(Random& random, int count,
                                                const pack::PackOptions& options = {}) {
  return pack::pack(random_scene(random, count), options);
}

// Rays from anywhere to anywhere, some along an axis; every other one ends after a few units.
inline shader::QueryRay random_ray(Random& random) {
  const Vec3 axes[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const Vec3 direction = random.below(10) == 0 ? axes[random.below(3)] : random.direction();
  const Vec3 origin = random.point(4);
  return query_ray(origin, direction, random.below(2) == 0 ? random.uniform(0, 8) : 1e30);
}

inline std::vector<shader::QueryRay> random_rays(Random& random, size_t count) {
  std::vector<shader::QueryRay> rays(count);
  for (shader::QueryRay& ray : rays) ray = random_ray(random);
  return rays;
}

}  // namespace eyeray::engine::test
