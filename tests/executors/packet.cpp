// Coherent rays, traced in packets, find the twin's hits: with narrow shafts, and where a search takes too
// long and is begun again.
#include <fmt/format.h>

#include "tests/support/empty_scene.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using test::Random;

namespace {

// A cloud of small triangles, and of spheres if `spheres`. A random half of the shapes let light through.
Scene cloud(Random& random, int count, double size, bool spheres) {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 8);
  const int opaque = test::add(scene, make_phong({}));
  const int glass = test::add(scene, make_dielectric({.shadow = 0.9}));
  for (int i = 0; i < count; ++i) {
    const Vec3 a = random.point(3);
    const int material = random.below(2) == 0 ? glass : opaque;
    if (spheres && random.below(3) == 0) {
      test::add(scene, make_sphere(a, size * random.uniform(0.1, 0.5)), material);
    } else {
      TriangleValues triangle;
      triangle.vertices = {a, a + random.point(size), a + random.point(size)};
      test::add(scene, make_triangle(triangle), material);
    }
  }
  return scene;
}

// Rays through the pixels of a picture, row by row; every seventh ends early, and one in `strays` goes
// elsewhere.
std::vector<shader::QueryRay> picture(Random& random, int size, int strays) {
  std::vector<shader::QueryRay> rays;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 pixel((x + 0.5) / size - 0.5, 0.5 - (y + 0.5) / size, -1);
      const bool stray = strays > 0 && random.below(strays) == 0;
      const Vec3 start = stray ? random.point(3) - Vec3(0, 0, 8) : Vec3(0);
      const double t_max = rays.size() % 7 == 0 ? random.uniform(0, 9) : 1e30;
      rays.push_back(test::query_ray(start, stray ? random.direction() : glm::normalize(pixel), t_max));
    }
  }
  return rays;
}

}  // namespace

TEST_CASE("nearest and any: rays in packets find the twin's hits, bit by bit") {
  gpu::Device device({});
  Random random(17);
  // If a BVH holds only triangles, its rays take turns in another way.
  for (const auto& [count, size, spheres, pixels, strays] :
       {std::tuple(3000, 0.1, true, 199, 0),  // narrow shafts
        {3000, 0.1, false, 199, 0},
        {200, 1.0, true, 199, 0},
        {200, 1.0, false, 199, 0},
        {20'000, 0.05, true, 33, 0},  // wide shafts, with hundreds of triangles
        {20'000, 0.05, false, 33, 0},
        {3000, 0.1, true, 101, 5},
        {3000, 0.1, false, 101, 5}}) {
    const PackedScene scene =
        pack::pack(cloud(random, count, size, spheres), {.acceleration = Acceleration::bvh});
    REQUIRE(scene.has_bvh);
    REQUIRE(scene.bvh_kinds.size() == (spheres ? 2 : 1));
    Specialisation specialisation;
    specialisation.profile = {.texel_buffers = true, .packets = true};
    test::QueryKernel kernel(device, scene, specialisation);
    REQUIRE(kernel.traces_packets());
    const std::vector<shader::QueryRay> rays = picture(random, pixels, strays);
    const std::vector<shader::QueryHit> nearest = test::query_twin(scene, rays, false);
    const std::vector<shader::QueryHit> any = test::query_twin(scene, rays, true);
    const auto hits =
        std::ranges::count_if(nearest, [](const shader::QueryHit& hit) { return hit.primitive != NONE; });
    const auto half = std::ranges::count_if(any, [](const shader::QueryHit& hit) {
      return hit.occlusion > 0 && hit.occlusion < OPTICAL_DEPTH_OPAQUE;
    });
    const int different =
        test::differences(kernel.ask(rays, false), nearest) + test::differences(kernel.ask(rays, true), any);
    MESSAGE(fmt::format("{} primitives: {} of {} rays hit, {} half in shadow, {} differ",
                        scene.primitives.size(), hits, rays.size(), half, different));
    CHECK(hits > int(rays.size()) / 20);
    CHECK(half > 10);
    CHECK(different == 0);
  }
}
