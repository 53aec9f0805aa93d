// Tests of the cost of the search for a first hit.
#include <algorithm>
#include <string>

#include "host/loader/scene_file.hpp"
#include "host/render/render.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

std::vector<FirstHit> first_hits(const Scene& scene, Backend backend, bool search_cost,
                                 Acceleration acceleration = Acceleration::bvh) {
  ExecutorOptions options;
  options.search_cost = search_cost;
  options.pack.acceleration = acceleration;
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<FirstHit> hits(size_t(all.pixels()));
  make_executor(backend, scene, options)->first_hits(all, hits);
  return hits;
}

}  // namespace

TEST_CASE("GPU and twin have the same search cost in TLAS, BLASes, deferred shapes, CSG objects and lists") {
  for (const std::string name :
       {"whitted", "sphereflake", "group_instances", "scattered", "shapes/gallery"}) {
    CAPTURE(name);
    Scene scene = loader::load_scene("scenes/" + name + ".toml");
    scene.image.width = 60;
    scene.image.height = 45;
    const auto gpu = first_hits(scene, Backend::gpu, true), twin = first_hits(scene, Backend::twin, true);
    CHECK(std::ranges::equal(gpu, twin, [](const FirstHit& a, const FirstHit& b) {
      return a.cost.nodes == b.cost.nodes && a.cost.tests == b.cost.tests;
    }));
    CHECK(std::ranges::any_of(gpu, [](const FirstHit& hit) { return hit.cost.tests > 0; }));
    CHECK(std::ranges::any_of(gpu, [](const FirstHit& hit) { return hit.cost.nodes > 0; }));
  }
}

TEST_CASE("by brute force every ray tests every primitive, and uncounted costs are marked unknown") {
  const Scene scene = loader::parse_scene(R"(
[image]
width = 8
height = 8
[camera]
eye = [0, 0, 9]
target = [0, 0, 0]
[[material]]
name = "white"
type = "phong"
[[sphere]]
radius = 1
material = "white"
batch = { center = [[0, 0, 0], [1, 0, 0], [2, 1, 0], [-1, 2, 0], [-2, -2, 0]] }
)",
                                          "scene.toml");
  for (const Backend backend : {Backend::gpu, Backend::twin})
    for (const FirstHit& hit : first_hits(scene, backend, true, Acceleration::brute_force)) {
      CHECK(hit.cost.nodes == 0);
      CHECK(hit.cost.tests == 5);
    }
  for (const FirstHit& hit : first_hits(scene, Backend::reference, true)) CHECK(hit.cost.tests == -1);
  for (const FirstHit& hit : first_hits(scene, Backend::gpu, false)) CHECK(hit.cost.tests == -1);
}
