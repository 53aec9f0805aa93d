// A BVH changes nothing: its hits are those of testing everything, to the last bit.
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <mutex>

#include "hard_scene.hpp"
#include "host/core/parallel_for.hpp"
#include "host/executors/specialise.hpp"
#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/render/render.hpp"
#include "host/scene/integrator.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// The counts of compared rays, and the first ones that differ.
class Tally {
 public:
  void compare(uint64_t seed, const char* what, std::span<const shader::QueryRay> rays,
               std::span<const shader::QueryHit> expected, std::span<const shader::QueryHit> found) {
    for (size_t i = 0; i < rays.size(); ++i) {
      ++compared;
      hits += expected[i].primitive != NONE;
      dimmed += expected[i].occlusion > 0 && expected[i].occlusion < OPTICAL_DEPTH_OPAQUE;
      if (bits(expected[i]) == bits(found[i])) continue;
      const std::lock_guard lock(mutex_);
      if (++different > 5) continue;
      const auto text = [](const shader::uvec4& hit) {
        return fmt::format("t {:.9g}, primitive {}, flags {}, sum {}", std::bit_cast<float>(hit.x),
                           int(hit.y), hit.z, hit.w);
      };
      shown_ += fmt::format("scene {}, {}, ray {}: {}; not {}\n", seed, what, i, text(bits(found[i])),
                            text(bits(expected[i])));
    }
  }
  std::string shown() const { return shown_; }

  std::atomic<int64_t> compared = 0, hits = 0, dimmed = 0, different = 0;

 private:
  std::mutex mutex_;
  std::string shown_;
};

// Compares `count` hard scenes on the GPU with the twin; every eight BVHs cover all profiles.
void hard_scenes_on_the_gpu(int count) {
  gpu::Device device({});
  Tally tally;
  int bvhs = 0, quantised = 0, with_splits = 0, with_instances = 0, together = 0;
  for (uint64_t seed = 20000; bvhs < count; ++seed) {
    HardScene hard{seed};
    const PackedScene brute = pack::pack(hard.scene(), {.acceleration = Acceleration::brute_force});
    const PackedScene bvh =
        pack::pack(hard.scene(), {.acceleration = Acceleration::bvh, .split = bvhs % 8 < 4});
    if (!bvh.has_bvh) continue;
    const bool splits = bvh.primitives.size() > brute.primitives.size();
    quantised += bvh.quantised_nodes;
    with_splits += splits;
    with_instances += !bvh.instances.empty();
    Specialisation specialisation;
    specialisation.profile = {
        .texel_buffers = bvhs % 2 == 0, .packets = bvhs % 8 < 6, .shift_stack = bvhs % 4 < 2};
    ++bvhs;
    const std::vector<shader::QueryRay> rays = hard.rays(5000);
    QueryKernel kernel(device, bvh, specialisation);
    together += kernel.traces_packets();
    for (const bool any : {false, true})
      tally.compare(seed, any ? "any" : "nearest", rays, query_twin(brute, rays, any), kernel.ask(rays, any));
  }
  MESSAGE(
      fmt::format("{} compared, {} hit, {} dimmed; of {} BVHs {} quantised, {} with splits, {} with "
                  "instances: {} differ",
                  tally.compared.load(), tally.hits.load(), tally.dimmed.load(), bvhs, quantised, with_splits,
                  with_instances, tally.different.load()));
  INFO(tally.shown());
  CHECK(tally.different == 0);
  CHECK(tally.hits > 400 * count);
  CHECK(quantised > count / 3);
  CHECK(with_splits > 0);
  CHECK(with_instances > count / 6);
  if (count <= 8) return;
  // Checks for features that few scenes have.
  CHECK(tally.dimmed > 40 * count);
  CHECK(quantised < bvhs);  // some BVHs have nodes that cannot be quantised
  CHECK(together > count / 6);
}

bool has_bvh(const std::string& file) {
  return pack::pack(loader::load_scene(file), {.acceleration = Acceleration::automatic}).has_bvh;
}

}  // namespace

TEST_CASE("a few shapes are in a BVH if their tests have loops") {
  CHECK(!has_bvh("scenes/shapes/cylinder.toml"));
  CHECK(has_bvh("scenes/shapes/polygon.toml"));
  CHECK(has_bvh("scenes/shapes/torus.toml"));
  CHECK(has_bvh("scenes/shapes/csg.toml"));
}

TEST_CASE(
    "33 primitives are searched without a BVH by paths alone, where many samples repay their compilation") {
  Scene scene = loader::load_scene("scenes/path/cornell_box.toml");
  const auto in_bvh = [&](int side, int samples) {
    scene.image.width = scene.image.height = side;
    scene.image.samples = samples;
    return pack::pack(scene, {.acceleration = Acceleration::automatic}).has_bvh;
  };
  CHECK(!in_bvh(256, 64));
  CHECK(in_bvh(256, 63));
  scene.render.integrator = IntegratorType::whitted;
  CHECK(in_bvh(256, 64));
}

TEST_CASE("10 000 hard scenes on the twin: the BVH finds what brute force finds, to the last bit" *
          doctest::test_suite("long")) {
  Tally whole, split;
  std::atomic<int> bvhs = 0, quantised = 0, with_splits = 0, with_instances = 0, with_groups = 0;
  // Three seeds, found among many more scenes, that once were wrong: CSG objects of glass in two leaves, and
  // an assertion in Embree.
  constexpr std::array once_wrong{117549, 220962, 249576};
  parallel_for(0, 10000 + int(once_wrong.size()), [&](int i) {
    const int seed = i < 10000 ? i : once_wrong[size_t(i - 10000)];
    HardScene hard{uint64_t(seed)};
    const std::vector<shader::QueryRay> rays = hard.rays(200);
    const PackedScene brute = pack::pack(hard.scene(), {.acceleration = Acceleration::brute_force});
    const PackedScene bvh = pack::pack(hard.scene(), {.acceleration = Acceleration::bvh});
    const PackedScene cut = pack::pack(hard.scene(), {.acceleration = Acceleration::bvh, .split = true});
    const bool splits = cut.primitives.size() > bvh.primitives.size();
    bvhs += bvh.has_bvh;
    quantised += bvh.has_bvh && bvh.quantised_nodes;
    with_instances += !bvh.instances.empty();
    with_groups += bvh.has_bvh && !hard.scene().groups.empty();
    with_splits += splits;
    for (const bool any : {false, true}) {
      const std::vector<shader::QueryHit> expected = query_twin(brute, rays, any);
      whole.compare(uint64_t(seed), any ? "any" : "nearest", rays, expected, query_twin(bvh, rays, any));
      if (splits)
        split.compare(uint64_t(seed), any ? "any" : "nearest", rays, expected, query_twin(cut, rays, any));
    }
  });
  MESSAGE(fmt::format(
      "{} compared, {} hit, {} dimmed; of {} BVHs {} quantised, {} with instances, {} of groups: {} differ",
      whole.compared.load(), whole.hits.load(), whole.dimmed.load(), bvhs.load(), quantised.load(),
      with_instances.load(), with_groups.load(), whole.different.load()));
  MESSAGE(fmt::format("{} compared with splits, {} BVHs: {} differ", split.compared.load(),
                      with_splits.load(), split.different.load()));
  {
    INFO(whole.shown());
    CHECK(whole.different == 0);
  }
  CHECK(whole.hits > 800'000);
  CHECK(whole.dimmed > 100'000);
  CHECK(quantised > 5000);
  CHECK(bvhs - quantised > 500);
  CHECK(with_instances > 4000);
  CHECK(with_groups > 3000);
  INFO(split.shown());
  CHECK(with_splits > 2000);
  CHECK(split.different == 0);
}

TEST_CASE("hard scenes on the GPU: a BVH finds what the twin finds by brute force, whatever the profile") {
  hard_scenes_on_the_gpu(3);
}

TEST_CASE("hard scenes on the GPU: many more" * doctest::test_suite("long")) {
  hard_scenes_on_the_gpu(24);
}

TEST_CASE("the validation layers report nothing about BVHs, instances and both ways to load them") {
  Scene scene = test::empty_scene();
  scene.image = {.width = 24, .height = 16};
  scene.camera.eye = Vec3(0, 0, 6);
  scene.camera.target = Vec3(0);
  add(scene, make_phong({}));
  add_point_light(scene, {3, 4, 5}, Vec3(1));
  const int mesh = add(scene, globe(12, 6));
  for (const double x : {-1.5, 1.5}) add_instance(scene, mesh, 0, translation({x, 0, 0}));
  REQUIRE(!pack::pack(scene).instances.empty());
  for (const char* layer : {"core", "sync"}) {
    for (const char* loads : {"texels", "storage"}) {
      ExecutorOptions options;
      options.gpu.validation = layer;
      options.gpu.profile.loads = loads;
      // A message of the validation layer is an error.
      const auto gpu = make_executor(Backend::gpu, scene, options);
      const Rendering ours = render::render(scene, *gpu, {.crop = {}, .first_hits = true, .progress = {}});
      const Rendering twins = render::render(scene, *make_executor(Backend::twin, scene, {}), {});
      CHECK(ours.color.samples() == twins.color.samples());
      std::vector<QueryHit> hit(1);
      const Query ray{{-1.5, 0, 6}, {0, 0, -1}};
      gpu->query({std::span(&ray, 1)}, hit);
      CHECK(hit[0].primitive >= 0);
    }
  }
}

TEST_CASE(
    "few triangles beside many spheres are in the linear list, wherever they lie; the BVH holds spheres "
    "alone") {
  Random random(5);
  Scene scene = test::empty_scene();
  const int material = test::add(scene, make_phong({}));
  for (int i = 0; i < 40; ++i)
    test::add(scene, make_sphere(random.point(2) * Vec3(1, 0.2, 1), random.log_uniform(0.05, 0.3)), material);
  for (const double side : {-3, 3}) {
    TriangleValues triangle;
    triangle.vertices = {Vec3(-3, -0.5, -3), Vec3(3, -0.5, 3), Vec3(side, -0.5, -side)};
    test::add(scene, make_triangle(triangle), material);
  }
  // A small one, high up.
  test::add(scene, make_triangle({.vertices = {Vec3(0, 1, 0), Vec3(0.2, 1, 0), Vec3(0, 1.1, 0.2)}}),
            material);
  const auto linear_triangles = [](const PackedScene& packed) {
    return packed.linear_ends[shader::KIND_triangle] - packed.first_linear(shader::KIND_triangle);
  };
  const PackedScene packed = pack::pack(scene, {});
  CHECK(linear_triangles(packed) == 3);
  CHECK(packed.bvh_kinds == std::set<uint32_t>{shader::KIND_sphere});

  std::vector<shader::QueryRay> rays(5000);
  for (shader::QueryRay& ray : rays) ray = test::random_ray(random);
  const PackedScene brute = pack::pack(scene, {.acceleration = Acceleration::brute_force});
  for (const bool any : {false, true})
    CHECK(test::differences(test::query_twin(packed, rays, any), test::query_twin(brute, rays, any)) == 0);

  // Six triangles would each be tested by every ray, so they go into the BVH.
  for (int i = 0; i < 3; ++i) {
    TriangleValues triangle;
    triangle.vertices = {Vec3(-3, -0.5, -3), Vec3(3, 0.1 * i, 3), Vec3(3, -0.5, -3)};
    test::add(scene, make_triangle(triangle), material);
  }
  CHECK(linear_triangles(pack::pack(scene, {})) == 0);
}
