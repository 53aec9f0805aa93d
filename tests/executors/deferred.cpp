// Rays that wait for each other at deferred shapes (bvh/traverse.glsl) find the same hits as rays that do
// not.
#include <algorithm>
#include <string>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// Rays from and towards random points around the camera's target.
std::vector<shader::QueryRay> rays_around(const Scene& scene) {
  Random random(5);
  std::vector<shader::QueryRay> rays;
  const Vec3 middle = scene.camera.target - scene.camera.eye;
  for (int i = 0; i < 6000; ++i) {
    const Vec3 from = middle + random.point(9);
    const Vec3 d = glm::normalize(middle + random.point(6) - from);
    rays.push_back(test::query_ray(from, d, i % 2 == 0 ? double(T_MISS) : random.uniform(1, 12)));
  }
  return rays;
}

void check_against_twin(gpu::Device& device, const Scene& scene, const PackedScene& packed, int least_hits) {
  const std::vector<shader::QueryRay> rays = rays_around(scene);
  for (const bool shift : {true, false}) {
    Specialisation specialisation;
    specialisation.profile = {.texel_buffers = shift, .packets = false, .shift_stack = shift};
    QueryKernel kernel(device, packed, specialisation);
    for (const bool any : {false, true}) {
      const std::vector<shader::QueryHit> expected = query_twin(packed, rays, any);
      CAPTURE(shift);
      CAPTURE(any);
      CHECK(differences(expected, kernel.ask(rays, any)) == 0);
      CHECK(std::ranges::count_if(expected, [&](const shader::QueryHit& hit) {
              return any ? hit.occlusion > 0 : hit.primitive != NONE;
            }) > least_hits);
    }
  }
}

}  // namespace

TEST_CASE("deferred shapes among others in a BVH, with and without instances: the GPU finds the twin's hits" *
          doctest::test_suite("long")) {
  gpu::Device device({});
  for (const std::string file :
       {"scenes/shapes/gallery.toml", "scenes/shapes/csg.toml", "scenes/group_shapes.toml"}) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    const PackedScene packed = pack::pack(scene, {.acceleration = Acceleration::bvh});
    REQUIRE(packed.has_bvh);
    size_t deferred = 0;
#define COUNT(name, number) deferred += packed.bvh_kinds.count(number);
    DEFERRED_SHAPES(COUNT)
    CHECK(deferred > 0);
    CHECK(deferred < packed.bvh_kinds.size());
    CHECK(packed.instances.empty() == (file != "scenes/group_shapes.toml"));
    check_against_twin(device, scene, packed, 2000);
  }
}

TEST_CASE("deferred shapes in instances without a BVH do not wait, and the GPU finds the twin's hits") {
  gpu::Device device({});
  const Scene scene = parse_scene(R"(
render = { groups = "instanced" }
[[material]]
name = "paint"
type = "phong"
[[group]]
name = "pair"
pattern = true
[[group.torus]]
material = "paint"
center = [0, 0, 0]
axis = [0, 1, 0]
major_radius = 1.5
minor_radius = 0.6
[[group.sphere]]
material = "paint"
center = [0, 0, 0]
radius = 0.8
[[instance]]
group = "pair"
batch = { transform = [[], [{ translate = [3, 1, 0] }], [{ scale = [1, 2, 1] }, { translate = [-4, 0, 1] }]] }
)",
                                  "scene.toml");
  const PackedScene packed = pack::pack(scene, {.acceleration = Acceleration::brute_force});
  CHECK(!packed.has_bvh);
  CHECK(packed.instances.size() == 3);
  check_against_twin(device, scene, packed, 500);
}
