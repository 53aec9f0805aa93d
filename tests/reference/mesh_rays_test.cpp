// Tests of the rounding of rays at meshes: no ray hits the triangle that it leaves again, and none slips
// between two triangles.
#include "host/core/parallel_for.hpp"
#include "host/reference/crossings.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("a ray that leaves a triangle of an instance does not hit it again") {
  Dice dice;
  int spawned = 0, rehits = 0;
  for (int i = 0; i < 30000; ++i) {
    const double size = dice.scale(-4, 4);
    const Vec3 center = dice.in_box(dice.scale(-4, 4));
    Mesh mesh = make_mesh({}, {{0, 1, 2}, {0, 2, 1}});
    for (int corner = 0; corner < 3; ++corner)
      mesh.positions.push_back(center + size * dice.in_box(1) * Vec3(1, i % 3 > 0, 1));
    // One mesh in five is a single needle. Its normal is so imprecise that the reversed triangle would have
    // another one.
    if (i % 5 == 0) {
      mesh.triangles.pop_back();
      mesh.positions[2] = glm::mix(mesh.positions[0], mesh.positions[1], dice.between(-1, 2)) +
                          size * dice.scale(-8, -2) * dice.direction();
    }
    if (thickness(corners(mesh, 0)) < thinnest_triangle) continue;
    const Mat4 map = random_map(dice, 0.8 * (i % 4), dice.scale(-4, 4));
    const reference::MeshGeometry geometry(mesh, Acceleration::bvh);
    const reference::InstanceGeometry instance({0, map, 0, {}}, geometry);
    const Vec3 middle = Affine(map).point((mesh.positions[0] + mesh.positions[1] + mesh.positions[2]) / 3.0);
    const Vec3 eye = middle + dice.direction() * size * dice.scale(-1, 3);
    const Ray ray{eye, middle - eye};
    const auto hit = instance.intersect(ray);
    if (!hit) continue;
    const SurfacePoint point = instance.surface(ray, *hit);
    for (int k = 0; k < 4; ++k) {
      const Vec3 d = dice.direction();
      ++spawned;
      rehits += instance.intersect({reference::spawn_origin(point, d), d}).has_value();
    }
    const Vec3 along = glm::normalize(ray.d);
    ++spawned;
    rehits += instance.intersect({reference::spawn_origin(point, along), along}).has_value();
  }
  MESSAGE(rehits << " re-hits in " << spawned << " spawned");
  CHECK(spawned > 100000);
  CHECK(rehits == 0);
}

TEST_CASE("closed meshes: no ray leaks, whatever the instance's map") {
  constexpr int parts = 20, rays = 20000;
  Dice dice;
  for (const double strongest : {0.0, 1.0, 3.0}) {
    Mesh mesh = globe(60, 31);
    for (Vec3& p : mesh.positions) p *= Vec3(1 + strongest, 1, 0.1);
    const reference::MeshGeometry geometry(mesh, Acceleration::bvh);
    const Mat4 map = random_map(dice, strongest, 100 * strongest);
    const reference::InstanceGeometry instance({0, map, 0, {}}, geometry);
    std::array<int, parts> escaped{};
    parallel_for(0, parts, [&](int part) {
      Random random{uint64_t(part)};
      for (int i = 0; i < rays; ++i) {
        const Vec3 eye =
            0.9 * mesh.positions[size_t(random.below(int(mesh.positions.size())))] * random.uniform(0, 1);
        const Corners v = corners(mesh, size_t(random.below(int(mesh.triangles.size()))));
        const Vec3 target = i % 3 == 0   ? v[0]
                            : i % 3 == 1 ? glm::mix(v[0], v[1], random.uniform())
                                         : glm::mix(v[1], v[2], random.uniform());
        const Affine to_world(map);
        const Vec3 o = to_world.point(eye);
        escaped[size_t(part)] += !instance.intersect({o, glm::normalize(to_world.point(target) - o)});
      }
    });
    int leaks = 0;
    for (const int count : escaped) leaks += count;
    MESSAGE(leaks << " leaks of " << parts * rays << " rays, stretched up to 10^" << 2 * strongest);
    CHECK(leaks == 0);
  }
}
