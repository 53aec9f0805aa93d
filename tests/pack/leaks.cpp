// Closed meshes do not leak, and rays that leave a surface do not hit it again: in the kernel, through the
// BVH, with baked meshes and with instances.
#include <fmt/format.h>

#include <map>

#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/amount.hpp"
#include "tests/support/empty_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

int effort() {
  return test::amount(1, 1, 10);
}

// A unit sphere: an icosahedron with each face split in four, `levels` times; vertices moved in and out by up
// to `jitter`.
Mesh icosphere(int levels, double jitter, Random& random) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  Mesh mesh = make_mesh({{-1, g, 0},
                         {1, g, 0},
                         {-1, -g, 0},
                         {1, -g, 0},
                         {0, -1, g},
                         {0, 1, g},
                         {0, -1, -g},
                         {0, 1, -g},
                         {g, 0, -1},
                         {g, 0, 1},
                         {-g, 0, -1},
                         {-g, 0, 1}},
                        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}});
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [entry, fresh] = middles.try_emplace(std::minmax(a, b), uint32_t(mesh.positions.size()));
      if (fresh) mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5);
      return entry->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& triangle : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(triangle);
    }
    mesh.triangles = finer;
  }
  for (Vec3& p : mesh.positions) p = glm::normalize(p) * (1 + random.uniform(-jitter, jitter));
  return mesh;
}

struct Placement {
  const char* name;
  Vec3 center;
  Vec3 scale;
};

enum class Kept { baked, instance, in_group };
constexpr Kept all_kept[] = {Kept::baked, Kept::instance, Kept::in_group};
constexpr const char* kept_names[] = {"baked", "an instance", "in a group"};

// The mesh, turned, scaled and moved to `placement`. As an instance or in a group it is shown a second time
// far away, so that both share a BVH.
struct PlacedMesh {
  PlacedMesh(Mesh mesh, const Placement& placement, Kept kept) {
    map = glm::scale(glm::rotate(translation(placement.center), 0.7, Vec3(0.6, 0, 0.8)), placement.scale);
    triangles = uint32_t(mesh.triangles.size());
    scene.camera.eye = Vec3(0);
    add(scene, make_phong({}));
    const int index = add(scene, std::move(mesh));
    const Mat4 second = translation(placement.center * 3.0 + 1000.0 * placement.scale) * map;
    if (kept == Kept::in_group) {
      scene.groups.emplace_back().instances.push_back({.mesh = index, .position = {}});
      for (const Mat4& each : {map, second}) scene.group_instances.push_back({0, each, 0, 0, {}});
    } else {
      add_instance(scene, index, 0, map);
      if (kept == Kept::instance) add_instance(scene, index, 0, second);
    }
    packed = pack::pack(scene, {.acceleration = Acceleration::bvh});
    REQUIRE(packed.instances.size() == (kept == Kept::baked ? 0 : 2));
  }
  Vec3 to_world(const Vec3& p) const { return Vec3(map * glm::dvec4(p, 1)); }
  bool is_hit(const shader::QueryHit& hit) const { return hit.primitive < triangles; }

  Scene scene = test::empty_scene();
  Mat4 map;
  uint32_t triangles;
  PackedScene packed;
};

enum class Aim { random, edges, vertices };
constexpr const char* aim_names[] = {"at random", "at edges", "at vertices"};

}  // namespace

TEST_CASE(
    "closed meshes leak no ray through the BVH, at any position and size, as needles and instances too" *
    doctest::test_suite("long")) {
  gpu::Device device({});
  Random random(11);
  const Mesh mesh = icosphere(3, 0.1, random);
  const Placement placements[] = {{"at the origin", Vec3(0), Vec3(1)},
                                  {"far away", {148376, 1234, -223423}, Vec3(1000)},
                                  {"radius 0.01", Vec3(0), Vec3(0.01)},
                                  {"needles", Vec3(0), {1, 0.001, 1}}};
  const int count = 50'000 * effort();
  int64_t all = 0;
  for (const Placement& placement : placements) {
    for (const Kept kept : all_kept) {
      const bool instanced = kept != Kept::baked;
      const PlacedMesh placed(mesh, placement, kept);
      Specialisation specialisation;
      specialisation.profile = {.texel_buffers = instanced, .packets = !instanced, .shift_stack = instanced};
      QueryKernel kernel(device, placed.packed, specialisation);
      for (const Aim aim : {Aim::random, Aim::edges, Aim::vertices}) {
        std::vector<shader::QueryRay> rays(static_cast<size_t>(count));
        for (shader::QueryRay& ray : rays) {
          const Vec3 origin = placed.to_world(random.point(0.2));
          const auto& [p, q, r] = mesh.triangles[size_t(random.below(int(placed.triangles)))];
          const double along = aim == Aim::edges ? random.uniform() : 0;
          const Vec3 target = glm::mix(mesh.positions[p], mesh.positions[q], along);
          const Vec3 direction = aim == Aim::random
                                     ? random.direction()
                                     : glm::normalize(placed.to_world(target) - Vec3(glm::vec3(origin)));
          ray = test::query_ray(origin, direction);
        }
        const std::vector<shader::QueryHit> hits = kernel.ask(rays, false);
        const auto leaks =
            std::ranges::count_if(hits, [&](const shader::QueryHit& hit) { return !placed.is_hit(hit); });
        MESSAGE(fmt::format("{}, {}, aimed {}: {} of {} leak", placement.name, kept_names[int(kept)],
                            aim_names[int(aim)], leaks, count));
        CHECK(leaks == 0);
        all += count;
      }
    }
  }
  MESSAGE(fmt::format("{} rays", all));
}

TEST_CASE("a ray leaving a convex mesh outward never hits it again: radius 1e-4 to 1e4, baked or instanced") {
  gpu::Device device({});
  Random random(12);
  const Mesh mesh = icosphere(3, 0, random);
  const Placement placements[] = {{"radius 1e-4", {1e-4, 2e-4, -3e-4}, Vec3(1e-4)},
                                  {"radius 1", {5, 3, -8}, Vec3(1)},
                                  {"radius 1e4", {3e4, 1e4, -2e4}, Vec3(1e4)},
                                  {"stretched", {0.5, 0, 0}, {1, 0.1, 3}},
                                  {"far away", {148376, 1234, -223423}, Vec3(1000)}};
  const size_t count = size_t(10'000 * effort());
  for (const Placement& placement : placements) {
    for (const Kept kept : all_kept) {
      const PlacedMesh placed(mesh, placement, kept);
      std::vector<shader::QueryRay> rays;
      const shader::Binding binding(twin::view_of(placed.packed));
      while (rays.size() < count) {
        const glm::vec3 origin(placed.to_world(random.direction() * random.log_uniform(1.1, 100)));
        const glm::vec3 target(placed.to_world(random.point(0.5)));
        const shader::Ray ray = shader::make_ray(origin, glm::normalize(target - origin));
        uint32_t flags = 0;
        const shader::Hit hit = shader::trace(ray, flags);
        if (hit.slot == NONE || hit.id >= placed.triangles) continue;
        const shader::Surface surface = shader::surface_at(shader::primitive_at(hit), ray, hit);
        glm::vec3 away(random.direction());
        if (random.below(4) == 0)
          away = glm::normalize(away -
                                surface.normal_geometric * glm::dot(away, surface.normal_geometric) * 0.999f);
        if (shader::dot3(away, surface.normal_geometric) < 0) away = -away;
        rays.push_back({shader::spawn_ray(surface, away).o, 0.0f, away, 1e30f});
      }
      QueryKernel kernel(device, placed.packed, {});
      const std::vector<shader::QueryHit> hits = kernel.ask(rays, false);
      const auto met =
          std::ranges::count_if(hits, [&](const shader::QueryHit& hit) { return placed.is_hit(hit); });
      MESSAGE(fmt::format("{}, {}: {} of {} hit again", placement.name, kept_names[int(kept)], met, count));
      CHECK(met == 0);
    }
  }
}
