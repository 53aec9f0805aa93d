// Four lanes a ray: the nodes that they traverse have the contents of the binary BVH, and the lanes find the
// twin's hits.
#include <fmt/format.h>

#include <map>

#include "tests/support/empty_scene.hpp"
#include "tests/support/query_kernel.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::pack;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::records;
using test::Random;

namespace {

constexpr double extent = 3;

// Triangles that are hard on BVHs: on a grid, so that corners and boxes coincide, needles, duplicates that
// tie. With `glass`, some also let light through, as a plane in the linear list does.
void add_hard_triangles(Scene& scene, Random& random, int count, bool glass) {
  const int opaque = test::add(scene, make_phong({}));
  const int other = glass ? test::add(scene, make_dielectric({.shadow = 0.9})) : opaque;
  if (glass) test::add(scene, make_plane({0, -1, 0}, {0, 1, 0}), other);
  TriangleValues triangle;
  for (int i = 0; i < count; ++i) {
    const int kind = int(random.below(6));
    Vec3 a = random.point(extent);
    const double reach = random.log_uniform(0.02, 1) * extent;
    Vec3 b = a + random.point(reach);
    Vec3 c = kind == 0 ? glm::mix(a, b, 0.4) + random.point(1e-5) : a + random.point(reach);
    if (kind == 1 || kind == 2) {
      a = glm::round(a * 2.0) / 2.0;
      b = a + Vec3(0.5, 0, 0);
      c = a + Vec3(0, kind == 1 ? 0.5 : 0, 0.5);
    }
    if (i == 0 || kind != 3) triangle.vertices = {a, b, c};
    test::add(scene, make_triangle(triangle), random.below(3) == 0 ? other : opaque);
  }
}

PackedScene packed(const Scene& scene, bool split) {
  PackedScene result = pack::pack(scene, {.acceleration = Acceleration::bvh, .split = split});
  REQUIRE(result.has_bvh);
  REQUIRE(result.quantised_nodes);
  return result;
}

bool within(const shader::uvec4& inner, const shader::uvec4& outer) {
  for (int axis = 0; axis < 3; ++axis)
    if ((inner[axis] & 0xffffu) < (outer[axis] & 0xffffu) || inner[axis] >> 16 > outer[axis] >> 16)
      return false;
  return true;
}

// For each slot in a BVH's leaves, the boxes around it, from the leaf's box upwards. `width`: the number of a
// node's children.
using Boxes = std::multimap<uint32_t, shader::uvec4>;
void gather(std::span<const shader::uvec4> nodes, uint32_t width, uint32_t node, Boxes& leaves) {
  for (uint32_t i = 0; i < width; ++i) {
    const shader::uvec4& child = nodes[width * node + i];
    if (child.w == NONE) continue;
    if (child.w >= LEAF) {
      for (uint32_t k = 0; k <= (child.w & 7u); ++k) leaves.emplace(((child.w & ~LEAF) >> 3) + k, child);
      continue;
    }
    Boxes below;
    gather(nodes, width, child.w, below);
    for (const auto& [slot, box] : below) CHECK(within(box, child));
    leaves.merge(below);
  }
}

}  // namespace

TEST_CASE("a BVH4 holds each slot of the binary BVH once, in boxes no smaller, at most four in a leaf") {
  Random random(3);
  for (const int count : {2, 3, 5, 30, 3000}) {
    Scene scene = test::random_scene(random, count < 30 ? 1 : 20);
    add_hard_triangles(scene, random, count, true);
    const PackedScene scene_packed = packed(scene, false);
    const CollapsedBvh bvh = collapse(scene_packed.nodes, scene_packed.bvhs[0]);
    Boxes binary, widened;
    gather(scene_packed.nodes, 2, scene_packed.bvhs[0].root, binary);
    gather(bvh.nodes, bvh4_children, 0, widened);
    CHECK(widened.size() == binary.size());
    for (const auto& [slot, box] : binary) {
      REQUIRE(widened.count(slot) == 1);
      const shader::uvec4& around = widened.find(slot)->second;
      CHECK(within(box, around));
      CHECK((around.w & 7u) < bvh4_children);
    }
    CHECK(bvh.nodes.size() / bvh4_children < scene_packed.nodes.size() / 2 + 1);
    CHECK(bvh.stack_size >= 1);
  }
}

TEST_CASE("nearest and any: four lanes a ray find the twin's hits, bit by bit") {
  gpu::Device device({});
  Random random(11);
  for (const auto& [shapes, triangles, split, texels] : {std::tuple(0, 300, false, true),
                                                         {0, 3000, false, true},
                                                         {0, 3000, true, false},
                                                         {40, 300, false, true},
                                                         {1, 2, false, false}}) {
    Scene scene = test::empty_scene();
    if (shapes > 0) scene = test::random_scene(random, shapes);
    add_hard_triangles(scene, random, triangles, !split);
    const PackedScene scene_packed = packed(scene, split);
    std::vector<shader::QueryRay> rays(50'003);  // no whole number of workgroups
    for (shader::QueryRay& ray : rays) ray = test::random_ray(random);
    // Half of the rays are in bundles that start together, as bounces do. So the rays of a bundle descend the
    // BVH together.
    for (size_t i = 0; i < rays.size() / 2; ++i) {
      rays[i].origin = rays[i / 16 * 16].origin;
      if (i % 3 == 0) rays[i].origin += glm::vec3(random.point(1e-3));
    }
    const std::vector<shader::QueryHit> nearest = test::query_twin(scene_packed, rays, false);
    const std::vector<shader::QueryHit> any = test::query_twin(scene_packed, rays, true);
    const auto hits =
        std::ranges::count_if(nearest, [](const shader::QueryHit& hit) { return hit.primitive != NONE; });
    const auto half = std::ranges::count_if(any, [](const shader::QueryHit& hit) {
      return hit.occlusion > 0 && hit.occlusion < OPTICAL_DEPTH_OPAQUE;
    });

    Specialisation specialisation;
    specialisation.profile.texel_buffers = texels;
    const CollapsedBvh bvh = collapse(scene_packed.nodes, scene_packed.bvhs[0]);
    test::QueryKernel kernel(device, scene_packed, specialisation, &bvh);
    const int different =
        test::differences(kernel.ask(rays, false), nearest) + test::differences(kernel.ask(rays, true), any);
    MESSAGE(fmt::format("{} primitives, stack {}: {} of {} rays hit, {} half in shadow, {} differ",
                        scene_packed.primitives.size(), bvh.stack_size, hits, rays.size(), half, different));
    CHECK(hits > 10'000);
    CHECK((split || half > 1'000));
    CHECK(different == 0);
  }
}

TEST_CASE("four lanes a ray: beyond a capped driver's steps every answer is the twin's, or flagged") {
  gpu::Device device({});
  Scene scene = test::empty_scene();
  const int opaque = test::add(scene, make_phong({}));
  TriangleValues triangle;
  triangle.vertices = {Vec3(-1, -1, -2), Vec3(1, -1, -2), Vec3(0, 1, -2)};
  for (int i = 0; i < 100'000; ++i) test::add(scene, make_triangle(triangle), opaque);
  const PackedScene scene_packed = packed(scene, false);
  const CollapsedBvh bvh = collapse(scene_packed.nodes, scene_packed.bvhs[0]);
  const std::vector<shader::QueryRay> rays(64, test::query_ray(Vec3(0), {0, 0, -1}));
  const std::vector<shader::QueryHit> nearest = test::query_twin(scene_packed, rays, false);
  test::QueryKernel kernel(device, scene_packed, {}, &bvh);
  const std::vector<shader::QueryHit> found = kernel.ask(rays, false);
  int flagged = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    CHECK(nearest[i].primitive == 0);
    if (found[i].flags & FLAG_LOOP_BUDGET)
      ++flagged;
    else
      CHECK(test::bits(found[i]) == test::bits(nearest[i]));
  }
  MESSAGE(fmt::format("{} of {} rays flagged", flagged, rays.size()));
}
