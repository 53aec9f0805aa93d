// Targets of hard rays: corners, edges and insides from a scene's records, in float32.
#pragma once

#include "host/pack/pack.hpp"
#include "tests/support/random.hpp"

namespace eyeray::engine::test {

struct RayTarget {
  glm::vec3 a, b, c;  // the shape's corners; for a sphere its centre, a pole and another point on it
};

// The targets on every primitive of the scene, once for each instance that shows it.
inline std::vector<RayTarget> ray_targets(const Scene& scene, Random& random) {
  std::vector<RayTarget> targets;
  const records::PackedScene packed = pack::pack(scene, {.acceleration = Acceleration::brute_force});
  const auto vertex = [&](uint32_t i) { return std::bit_cast<glm::vec4>(packed.vertices.at(i)); };
  const auto take = [&](const shader::Primitive& p, const shader::Instance* instance) {
    RayTarget target{glm::vec3(p.a), glm::vec3(p.b), glm::vec3(p.c)};
    if (kind_of(p) == shader::KIND_sphere) {
      glm::vec3 pole(0);
      pole[random.below(3)] = random.uniform() < 0.5 ? p.a.w : -p.a.w;
      target.b = target.a + pole;
      target.c = target.a + glm::vec3(random.direction()) * p.a.w;
    } else if (kind_of(p) == shader::KIND_csg) {
      target.b = target.a + glm::vec3(p.b);
      target.c = target.a + glm::vec3(p.b.x, -p.b.y, 0);
    } else if (kind_of(p) == shader::KIND_plane) {
      target = {target.a * p.a.w, target.a * p.a.w + target.b, target.a * p.a.w + target.c};
    } else if (kind_of(p) == shader::KIND_polygon) {
      const uint32_t path = p.extra + 2;
      target = {glm::vec3(vertex(path)), glm::vec3(vertex(path + 1)), glm::vec3(vertex(path + 2))};
    } else if (kind_of(p) != shader::KIND_triangle && kind_of(p) != shader::KIND_parallelogram) {
      // The centre of object space, and where two of its axes leave the unit cube.
      const glm::vec4 x = vertex(p.extra), y = vertex(p.extra + 1), z = vertex(p.extra + 2);
      target.a = {x.w, y.w, z.w};
      target.b = target.a + glm::vec3(x.x, y.x, z.x);
      target.c = target.a + glm::vec3(x.y, y.y, z.y);
    }
    if (instance) {
      for (glm::vec3* corner : {&target.a, &target.b, &target.c}) {
        Vec3 moved;
        for (int row = 0; row < 3; ++row) {
          const glm::dvec4 map(instance->to_world[row]);
          moved[row] = glm::dot(Vec3(map), Vec3(*corner)) + map.w;
        }
        *corner = glm::vec3(moved);
      }
    }
    targets.push_back(target);
  };
  for (uint32_t i = 0; i < packed.bvhs[0].end_slot; ++i) take(packed.primitives[i], nullptr);
  for (const shader::Instance& instance : packed.instances)
    for (uint32_t i = packed.bvhs[instance.bvh].first_slot; i < packed.bvhs[instance.bvh].end_slot; ++i)
      take(packed.primitives[i], &instance);
  return targets;
}

}  // namespace eyeray::engine::test
