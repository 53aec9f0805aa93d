// A driver that ends loops early must not go unnoticed: a pixel is right, or it is flagged.
#include <fmt/format.h>

#include <numbers>

#include "host/executors/executor.hpp"
#include "host/loader/scene_file.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;

namespace {

// Two mirrors face to face with `count` little spheres between them: each bounce tests every sphere.
Scene hall_of_mirrors(int count, int depth) {
  std::string text = fmt::format(
      "image = {{ width = 24, height = 16 }}\n"
      "camera = {{ eye = [0.1, 0.2, 0], target = [1, 0.25, 0.1], fov = 60 }}\n"
      "render = {{ max_depth = {}, background = [0.1, 0.2, 0.3], ambient = [1, 1, 1] }}\n",
      depth);
  text += "[[light]]\ntype = \"directional\"\ndirection = [0, -1, 0]\nintensity = 0.5\n";
  text += "[[material]]\nname = \"mirror\"\ntype = \"phong\"\ndiffuse = 0.02\nreflectance = 0.98\n";
  for (const double x : {-2.0, 2.0})
    text += fmt::format("[[plane]]\npoint = [{}, 0, 0]\nnormal = [1, 0, 0]\nmaterial = \"mirror\"\n", x);
  for (int i = 0; i < count; ++i)
    text += fmt::format("[[sphere]]\ncenter = [{}, -3, {}]\nradius = 0.01\nmaterial = \"mirror\"\n",
                        0.1 * (i % 17), 0.1 * (i / 17));
  return parse_scene(text, "hall_of_mirrors.toml");
}

ExecutorOptions one_by_one() {
  ExecutorOptions options;
  options.pack.acceleration = Acceleration::brute_force;
  return options;
}

// Two mirrors that face each other, and between them `count` rings of 2 × 8 000 vertices, over which a ray
// must iterate.
Scene hall_of_rings(int count, int depth) {
  const auto circle = [](double radius) {
    Outline outline;
    for (int i = 0; i < 8000; ++i) {
      const double angle = 2 * std::numbers::pi * i / 8000;
      outline.emplace_back(0, radius * std::cos(angle), radius * std::sin(angle));
    }
    return outline;
  };
  const PlanarRegion ring{circle(3), {circle(2)}};
  Scene scene = hall_of_mirrors(0, depth);
  for (int i = 0; i < count; ++i)
    test::add(scene, make_polygon(ring, test::translation({-1.5 + 3.0 * i / count, 0, 0})), 0);
  return scene;
}

// Checks that every pixel of the GPU equals the twin's, or is flagged.
void check_right_or_flagged(const Scene& scene, Executor& gpu, Executor& twin) {
  const Rect all{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> ours(size_t(all.pixels())), theirs(size_t(all.pixels()));
  REQUIRE(gpu.sample(all, 0, ours));
  REQUIRE(twin.sample(all, 0, theirs));
  int flagged = 0;
  for (size_t i = 0; i < ours.size(); ++i) {
    if (ours[i].flags & loop_budget)
      ++flagged;
    else
      CHECK(ours[i].color == theirs[i].color);
  }
  MESSAGE(fmt::format("{} of {} pixels flagged on {}", flagged, ours.size(), gpu.facts().description));
}

}  // namespace

TEST_CASE("beyond a capped driver's iterations every pixel is the twin's, or flagged") {
  const Scene scene = hall_of_mirrors(1200, 60);
  const auto gpu = make_executor(Backend::gpu, scene, one_by_one());
  const auto twin = make_executor(Backend::twin, scene, one_by_one());
  check_right_or_flagged(scene, *gpu, *twin);
}

TEST_CASE("a scene too large for one ray on a capped driver is refused with the numbers, or rendered right") {
  const Scene scene = hall_of_mirrors(31000, 1);
  try {
    const auto gpu = make_executor(Backend::gpu, scene, one_by_one());
    const auto twin = make_executor(Backend::twin, scene, one_by_one());
    const Rect row{0, 0, scene.image.width, 1};
    std::vector<PixelSample> ours(size_t(row.pixels())), theirs(size_t(row.pixels()));
    REQUIRE(gpu->sample(row, 0, ours));
    REQUIRE(twin->sample(row, 0, theirs));
    for (size_t i = 0; i < ours.size(); ++i) CHECK(ours[i].color == theirs[i].color);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::no_device);
    CHECK(std::string(error.what()).find("31002 primitives") != std::string::npos);
  }
}

TEST_CASE("iterations around outlines count: pixels are the twin's or flagged, and too many are refused") {
  // A ray and its shadow ray take 8 000 iterations with one ring, 24 000 with three.
  for (const int rings : {1, 3}) {
    const Scene scene = hall_of_rings(rings, 4);
    const auto gpu = make_executor(Backend::gpu, scene, one_by_one());
    const auto twin = make_executor(Backend::twin, scene, one_by_one());
    check_right_or_flagged(scene, *gpu, *twin);
  }

  const Scene large = hall_of_rings(8, 1);
  try {
    const auto capless = make_executor(Backend::gpu, large, one_by_one());
    check_right_or_flagged(large, *capless, *make_executor(Backend::twin, large, one_by_one()));
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::no_device);
    CHECK(std::string(error.what()).find("10 primitives (32008 iterations around their outlines)") !=
          std::string::npos);
  }
}

TEST_CASE("beyond a capped driver's iterations in a BVH every pixel is the twin's, or flagged") {
  // No box separates these spheres: a ray tests them all, and the first one is the nearest.
  constexpr int count = 70'000;
  Scene scene = test::empty_scene();
  scene.image = {.width = 16, .height = 8};
  scene.camera.eye = Vec3(0, 0, 5);
  scene.render.ambient = Vec3(1);
  test::add(scene, make_phong({}));
  test::add(scene, make_phong({.diffuse = textures::make_constant(Vec3(0))}));
  for (int i = 0; i < count; ++i) test::add(scene, make_sphere(Vec3(0), 1), i == 0 ? 0 : 1);
  const auto gpu = make_executor(Backend::gpu, scene, {});
  const auto twin = make_executor(Backend::twin, scene, {});

  check_right_or_flagged(scene, *gpu, *twin);

  // Ray queries have no room for a flag: their hits are right, or the call is an error.
  for (const QueryKind kind : {QueryKind::nearest, QueryKind::any}) {
    std::vector<Query> rays;
    for (int i = 0; i < 64; ++i) rays.push_back({Vec3(0.001 * i, 0, 5), Vec3(0, 0, -1)});
    std::vector<QueryHit> found(rays.size()), expected(rays.size());
    twin->query({rays, kind}, expected);
    try {
      gpu->query({rays, kind}, found);
      for (size_t i = 0; i < rays.size(); ++i) {
        CHECK(found[i].t == expected[i].t);
        CHECK(found[i].primitive == expected[i].primitive);
      }
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::no_device);
      CHECK(std::string(error.what()).find("ends loops after 65 535") != std::string::npos);
    }
  }
}

TEST_CASE(
    "whichever loop a driver cuts off, in a BVH or the linear list, a ray's occlusion is right or flagged") {
  // The spheres absorb so little that a ray goes through all of them.
  constexpr int count = 70'000;
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 5);
  test::add(scene, make_dielectric({.shadow = 0.99999}));
  for (int i = 0; i < count; ++i) test::add(scene, make_sphere(Vec3(0), 1), 0);
  std::vector<shader::QueryRay> rays;
  for (int i = 0; i < 64; ++i) rays.push_back(test::query_ray(Vec3(0.02 * i, 0, 0), Vec3(0, 0, -1)));

  gpu::Device device({});
  for (const Acceleration acceleration : {Acceleration::bvh, Acceleration::brute_force}) {
    const PackedScene packed = pack::pack(scene, {.acceleration = acceleration});
    const std::vector<shader::QueryHit> expected = test::query_twin(packed, rays, true);
    CHECK(expected[0].occlusion > count);
    CHECK(expected[0].occlusion < OPTICAL_DEPTH_OPAQUE);
    for (const bool texels : {false, true}) {
      Specialisation specialisation;
      specialisation.profile = {.texel_buffers = texels, .shift_stack = texels};
      test::QueryKernel kernel(device, packed, specialisation);
      const std::vector<shader::QueryHit> found = kernel.ask(rays, true);
      int flagged = 0, wrong = 0, silent = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        const bool flag = (found[i].flags & FLAG_LOOP_BUDGET) != 0;
        const bool right = found[i].occlusion == expected[i].occlusion;
        flagged += flag;
        wrong += !right;
        silent += !right && !flag;
      }
      MESSAGE(fmt::format("{} of {} rays wrong, {} flagged", wrong, rays.size(), flagged));
      CHECK(silent == 0);
    }
  }
}
