// Rays that wait with slow shapes for each other (traverse.glsl) find what rays find that do not.
#include <algorithm>
#include <string>

#include "loader/scene_file.hpp"
#include "query_kernel.hpp"
#include "render/pack.hpp"
#include "support/random.hpp"

#include "support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

TEST_CASE(
    "slow shapes among others in a tree, with instances and without: the GPU finds what the twin does") {
  gpu::Device device({});
  for (const std::string file : {"scenes/shapes/gallery.toml", "scenes/group_shapes.toml"}) {
    CAPTURE(file);
    const Scene scene = load_scene(file);
    const PackedScene packed = pack(scene, {.acceleration = Acceleration::tree});
    REQUIRE(packed.has_tree);
    size_t slow = 0;
#define COUNT(name, number) slow += packed.tree_kinds.count(number);
    SLOW_SHAPES(COUNT)
    CHECK(slow > 0);
    CHECK(slow < packed.tree_kinds.size());
    CHECK(packed.instances.empty() == (file == "scenes/shapes/gallery.toml"));

    Random random(5);
    std::vector<shader::QueryRay> rays;
    const Vec3 middle = scene.camera.target - scene.camera.eye;
    for (int i = 0; i < 6000; ++i) {
      const Vec3 from = middle + random.point(9);
      const Vec3 d = glm::normalize(middle + random.point(6) - from);
      rays.push_back({to_vec4(from), to_vec4(d, i % 2 == 0 ? double(T_MISS) : random.uniform(1, 12))});
    }
    for (const bool shift : {true, false}) {
      Specialisation specialisation;
      specialisation.profile = {.texel_buffers = shift, .packets = false, .shift_stack = shift};
      QueryKernel kernel(device, packed, specialisation);
      for (const bool any : {false, true}) {
        const std::vector<shader::QueryHit> expected = ask_twin(packed, rays, any),
                                            found = kernel.ask(rays, any);
        const auto count = [&](const auto& is) { return std::ranges::count_if(expected, is); };
        CAPTURE(shift);
        CAPTURE(any);
        CHECK(differences(expected, found) == 0);
        CHECK(count([&](const shader::QueryHit& hit) { return any ? hit.hit.w > 0 : hit.hit.y != NONE; }) >
              2000);
      }
    }
  }
}
