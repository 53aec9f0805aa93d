// points.glsl: which of the points that a ray hits at the same t is hit, and their colours.
#include <algorithm>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

// Points at ten positions, each ten times, in any order. The red of a point is its number, as a share of all.
std::string heap(Random& random) {
  std::string points, colors;
  for (int i = 0; i < 100; ++i) {
    points += fmt::format("[{}, 0, 0], ", random.below(10));
    colors += fmt::format("[{}, 0, 1], ", i / 128.0);
  }
  return "[[material]]\nname = \"m\"\ntype = \"phong\"\n[[points]]\nradius = 0.4\nmaterial = \"m\"\npoints = "
         "[" +
         points + "]\ncolors = [" + colors + "]\n";
}

}  // namespace

TEST_CASE("of points at one position the first of the table is hit, in any order of the search") {
  int rays = 0;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Random random{seed};
    const Scene scene = loader::parse_scene(heap(random), "heap.toml");
    for (const Acceleration acceleration : {Acceleration::bvh, Acceleration::brute_force}) {
      const records::PackedScene packed = pack::pack(scene, {.acceleration = acceleration});
      CHECK(packed.pieces);
      CHECK(packed.own_colors);
      const shader::Binding binding(twin::view_of(packed));
      for (int i = 0; i < 10; ++i) {
        const Vec3 to = Vec3(i, 0, 0) + random.point(0.2) - scene.camera.eye;
        uint32_t flags = 0;
        const shader::Hit hit =
            shader::trace(shader::make_ray(glm::vec3(0), glm::vec3(glm::normalize(to))), flags);
        const auto exact = scene.shapes[0]->intersect({scene.camera.eye, to});
        CHECK((hit.slot != NONE) == exact.has_value());
        if (hit.slot == NONE) continue;
        ++rays;
        const shader::vec3 color = shader::own_color(shader::load_primitive(hit.slot), hit);
        CHECK(color.x == float(exact->part) / 128);
        CHECK(color.z == 1);
        CHECK(hit.id == 0);
      }
    }
  }
  CHECK(rays > 700);
}
