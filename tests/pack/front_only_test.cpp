// Materials that exist only in front: nearest and shadow rays from behind such a triangle hit the surfaces
// beyond it, in every search. This test computes the expectation itself, in world space.
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "host/materials/make.hpp"
#include "host/reference/tracer.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::pack;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// Loose triangles and balls, some of them mirrored; every second instance exists only in front.
Scene one_sided_scene(Random& random, int instances) {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0);
  scene.camera.target = Vec3(0, 0, -1);
  for (int i = 0; i < 2; ++i) add(scene, make_phong({}));
  scene.materials[0]->front_only = true;
  Mesh loose;
  for (uint32_t i = 0; i < 12; ++i) {
    const Vec3 a = random.point(2);
    for (const Vec3& p : {a, a + random.point(1), a + random.point(1)}) loose.positions.push_back(p);
    loose.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const int meshes[] = {add(scene, std::move(loose)), add(scene, globe(8, 4))};
  for (int i = 0; i < instances; ++i) {
    const Vec3 scale(random.below(2) == 0 ? -0.7 : 0.8, random.uniform(0.5, 1), 1);
    add_instance(scene, meshes[i / 2 % 2], i % 2,
                 glm::scale(glm::translate(Mat4(1.0), random.point(3)), scale));
  }
  return scene;
}

struct Expected {
  uint32_t nearest = NONE;
  bool occluded = false;
  bool culled = false;  // whether the ray hit a front-only triangle from behind
};

// The expected hit, by Möller and Trumbore's test of one triangle after the other.
Expected expected(const Scene& scene, const shader::QueryRay& ray) {
  const Vec3 o(ray.origin), d(ray.direction);
  Expected found;
  double nearest = double(ray.t_max);
  uint32_t id = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
    const double outside = glm::determinant(Mat3(instance.transform)) < 0 ? -1 : 1;
    for (const auto& corners : mesh.triangles) {
      Vec3 v[3];
      for (size_t k = 0; k < 3; ++k) v[k] = Vec3(instance.transform * Vec4(mesh.positions[corners[k]], 1));
      const Vec3 e1 = v[1] - v[0], e2 = v[2] - v[0], p = glm::cross(d, e2), f = o - v[0];
      const double det = glm::dot(e1, p);
      const double u = glm::dot(f, p) / det, w = glm::dot(d, glm::cross(f, e1)) / det;
      const double t = glm::dot(e2, glm::cross(f, e1)) / det;
      if (u >= 0 && w >= 0 && u + w <= 1 && t > 0 && t < double(ray.t_max)) {
        const bool behind = glm::dot(outside * glm::cross(e1, e2), d) >= 0;
        const bool is_culled = instance.material == 0 && behind;
        found.culled |= is_culled;
        if (!is_culled) {
          found.occluded = true;
          if (t < nearest) found.nearest = id, nearest = t;
        }
      }
      ++id;
    }
  }
  return found;
}

}  // namespace

TEST_CASE("one-sided meshes are not hit from behind, in any kind of search") {
  Random random(11);
  for (const int instances : {1, 3, 12}) {
    CAPTURE(instances);
    const Scene scene = one_sided_scene(random, instances);
    const reference::Tracer tracer(scene);
    const std::vector<shader::QueryRay> rays = random_rays(random, 4000);
    int culled = 0, apart = 0;
    for (const Acceleration acceleration : {Acceleration::bvh, Acceleration::brute_force}) {
      const PackedScene packed = pack::pack(scene, {.acceleration = acceleration});
      const auto nearest = query_twin(packed, rays, false), occluded = query_twin(packed, rays, true);
      for (size_t i = 0; i < rays.size(); ++i) {
        const Expected right = expected(scene, rays[i]);
        const Ray exact{Vec3(rays[i].origin), Vec3(rays[i].direction)};
        const auto hit = tracer.trace(exact);
        const bool within = hit && hit->at.t < double(rays[i].t_max);
        uint32_t flags = 0;
        const double through = tracer.transmittance(exact, double(rays[i].t_max), flags);
        culled += right.culled;
        apart += right.nearest != (within ? uint32_t(hit->primitive) : NONE);
        apart += right.nearest != nearest[i].primitive;
        apart += right.occluded != (through == 0);
        apart += right.occluded != (occluded[i].occlusion == OPTICAL_DEPTH_OPAQUE);
      }
    }
    CHECK(culled > 10);
    CHECK(apart < 4);  // rays that hit an edge
  }
}

TEST_CASE("one-sided meshes: the GPU finds what the twin finds" * doctest::test_suite("long")) {
  gpu::Device device({});
  Random random(12);
  for (const int instances : {1, 12}) {
    const Scene scene = one_sided_scene(random, instances);
    CHECK(differences_on_gpu(device, pack::pack(scene, {}), random_rays(random, 20'000)) == 0);
  }
}
