// Cutouts by alpha: nearest and shadow rays hit the surface behind a cutout, in every way of searching.
#include <fmt/format.h>

#include "host/pack/collapse.hpp"
#include "host/reference/tracer.hpp"
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
using namespace eyeray::engine::test;

namespace {

// A mask of 3 × 2 texels with various alphas; the last is exactly the cutoff.
AlphaMask picture_mask(Filter filter) {
  auto image = std::make_shared<ImageTexture>();
  image->width = 3;
  image->height = 2;
  for (const int alpha : {255, 0, 140, 10, 200, 128}) image->texels.push_back({9, 9, 9, uint8_t(alpha)});
  image->filter = filter;
  return {textures::make_image(image), 128.0 / 255};
}

// A scene of four materials: with cutouts by checks, with cutouts by a picture, one that blends by a factor,
// and one without alpha. Instances have alphas at their vertices too.
Scene leafy_scene(Random& random, int count, int instances) {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0);
  scene.camera.target = Vec3(0, 0, -1);
  for (int i = 0; i < 4; ++i) add(scene, make_phong({}));
  scene.materials[0]->mask = AlphaMask{textures::make_checker(Vec3(1), Vec3(0.2), Vec2(0.3)), 0.5};
  scene.materials[1]->mask = picture_mask(Filter::bilinear);
  scene.materials[2]->mask = AlphaMask{.alpha = textures::make_constant(Vec3(0.8)), .blends = true};
  for (int i = 0; i < count; ++i) {
    TriangleValues triangle;
    const Vec3 a = random.point(3);
    triangle.vertices = {a, a + random.point(2), a + random.point(2)};
    if (i % 2) triangle.uv = {{Vec2(0, 0), Vec2(2, 0), Vec2(-1, 3)}};
    add(scene, make_triangle(triangle), i % 4);
  }
  if (instances == 0) return scene;
  Mesh mesh = globe(12, 6);
  for (const Vec3& p : mesh.positions) {
    mesh.colors.push_back(Vec3(1));
    mesh.alphas.push_back(0.5 + 0.5 * p.x);
  }
  const int globe_mesh = add(scene, std::move(mesh));
  for (int i = 0; i < instances; ++i)
    add_instance(scene, globe_mesh, i % 3, translation(random.point(3)) * glm::scale(Mat4(1.0), Vec3(0.7)));
  return scene;
}

}  // namespace

TEST_CASE(
    "an alpha below the cutoff is cut out, and the next surface is hit; an alpha at the cutoff is not") {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0);
  scene.camera.target = Vec3(0, 0, -1);
  for (int i = 0; i < 2; ++i) add(scene, make_phong({}));
  scene.materials[0]->mask = picture_mask(Filter::nearest);
  for (const double z : {-1, -2})
    add(scene, make_parallelogram({-3, -2, z}, {6, 0, 0}, {0, 4, 0}), z == -1 ? 0 : 1);
  const PackedScene packed = pack::pack(scene, {});
  const reference::Tracer tracer(scene);
  const bool there[] = {true, false, true, false, true, true};  // as picture_mask has them
  for (int texel = 0; texel < 6; ++texel) {
    const Vec3 to(-2 + 2 * (texel % 3), texel < 3 ? 1 : -1, -1);
    const shader::QueryRay ray = query_ray(to + Vec3(0, 0, 1), {0, 0, -1}, 1.5);
    CAPTURE(texel);
    CHECK(query_twin(packed, {&ray, 1}, true)[0].occlusion == (there[texel] ? OPTICAL_DEPTH_OPAQUE : 0u));
    shader::QueryRay endless = ray;
    endless.t_max = T_MISS;
    CHECK(query_twin(packed, {&endless, 1}, false)[0].primitive == (there[texel] ? 0u : 1u));
    const Ray exact{to + Vec3(0, 0, 1), {0, 0, -1}};
    CHECK(tracer.trace(exact)->primitive == (there[texel] ? 0u : 1u));
    uint32_t flags = 0;
    CHECK(tracer.transmittance(exact, 1.5, flags) == (there[texel] ? 0.0 : 1.0));
  }
}

TEST_CASE("cutouts: BVHs find what brute force finds, and in float64 too, to the last bit" *
          doctest::test_suite("long")) {
  Random random(3);
  for (const int instances : {0, 5}) {
    const Scene scene = leafy_scene(random, 200, instances);
    const std::vector<shader::QueryRay> rays = random_rays(random, 100'000);
    const PackedScene brute = pack::pack(scene, {.acceleration = Acceleration::brute_force});
    int cut = 0, apart = 0;
    for (const bool any : {false, true}) {
      const auto expected = query_twin(brute, rays, any);
      for (const bool split : {false, true})
        CHECK(differences(expected,
                          query_twin(pack::pack(scene, {.acceleration = Acceleration::bvh, .split = split}),
                                     rays, any)) == 0);
      PackedScene filled = brute;
      for (shader::Material& material : filled.materials) material.alpha_cutoff = 0;
      cut += differences(expected, query_twin(filled, rays, any));
      if (any) continue;
      const reference::Tracer tracer(scene);
      for (size_t i = 0; i < rays.size(); ++i) {
        const auto hit = tracer.trace({Vec3(rays[i].origin), Vec3(rays[i].direction)});
        const bool within = hit && hit->at.t < double(rays[i].t_max);
        apart += expected[i].primitive != (within ? uint32_t(hit->primitive) : NONE);
      }
    }
    MESSAGE(fmt::format("{} instances: {} of {} rays hit cutouts, {} differ from float64", instances, cut,
                        2 * rays.size(), apart));
    CHECK(cut > 19'000);
    CHECK(apart < 100);  // rays for which rounding decides the side of a cutout's edge
  }
}

TEST_CASE("cutouts: in every search the GPU finds what the twin finds" * doctest::test_suite("long")) {
  gpu::Device device({});
  Random random(4);
  for (const auto& [count, instances] : {std::pair(12, 0), {200, 0}, {200, 4}}) {
    const Scene scene = leafy_scene(random, count, instances);
    const PackedScene packed = pack::pack(scene, {});
    const std::vector<shader::QueryRay> rays = random_rays(random, 20'000);
    CHECK(differences_on_gpu(device, packed, rays) == 0);
    if (packed.has_bvh && packed.quantised_nodes && instances == 0) {
      const CollapsedBvh bvh4 = collapse(packed.nodes, packed.bvhs[0]);
      QueryKernel kernel(device, packed, {}, &bvh4);
      for (const bool any : {false, true})
        CHECK(differences(kernel.ask(rays, any), query_twin(packed, rays, any)) == 0);
    }
  }
}
