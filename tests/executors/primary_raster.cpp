// Eye rays by the device's rasteriser: what is drawn is what is traced, but at edges.
#include <algorithm>

#include "host/executors/executors.hpp"
#include "host/executors/primary_raster.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/integrator.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::executors;
using namespace eyeray::shapes;
using namespace eyeray::materials;
using test::Random;

namespace {

constexpr int width = 61, height = 47, side = 2;

// Triangles of some pixels each, one of them before another, mirrors and glass among them; and some spheres.
Scene triangles_and_spheres(int scale = 1) {
  Random random(23);
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 8);
  scene.image.width = scale * width;
  scene.image.height = scale * height;
  scene.image.samples = side * side;
  PhongValues shining;
  shining.emission = textures::make_constant(Vec3(0.3, 0.2, 0.1));
  const int materials[] = {test::add(scene, make_phong(shining)), test::add(scene, make_dielectric({})),
                           test::add(scene, make_mirror({}))};
  for (int i = 0; i < 120; ++i) {
    const Vec3 a = random.point(3);
    const int material = materials[random.below(3)];
    TriangleValues triangle;
    triangle.vertices = {a, a + random.point(2), a + random.point(2)};
    if (i % 8 == 0)
      test::add(scene, make_sphere(a, 0.3), material);
    else
      test::add(scene, make_triangle(triangle), material);
  }
  return scene;
}

// One-sided squares before a wall, each over a quarter of the picture: the upper two face the viewer, and the
// left upper one and the right lower one are mirrored.
Scene one_sided_squares() {
  Scene scene = test::empty_scene();
  scene.camera.eye = Vec3(0, 0, 8);
  scene.image.width = width;
  scene.image.height = height;
  scene.image.samples = side * side;
  scene.render.ambient = Vec3(1);
  PhongValues square, wall;
  square.diffuse = textures::make_constant(Vec3(1, 0, 0));
  wall.diffuse = textures::make_constant(Vec3(0, 0, 1));
  const int front = test::add(scene, make_phong(square)), behind = test::add(scene, make_phong(wall));
  scene.materials[size_t(front)]->front_only = true;
  TriangleValues triangle;
  triangle.vertices = {Vec3(-90, -90, -2), Vec3(90, -90, -2), Vec3(0, 90, -2)};
  test::add(scene, make_triangle(triangle), behind);
  for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
    std::vector<std::array<uint32_t, 3>> corners{{0, 1, 2}, {0, 2, 3}};
    if (y < 0) corners = {{2, 1, 0}, {3, 2, 0}};
    const int mesh = test::add(
        scene, test::make_mesh({Vec3(0, 0, 0), Vec3(20, 0, 0), Vec3(20, 20, 0), Vec3(0, 20, 0)}, corners));
    test::add_instance(scene, mesh, front, glm::scale(Mat4(1.0), Vec3(x, y, 1)));
  }
  return scene;
}

std::vector<PixelSample> samples_of(const Scene& scene, PrimaryRays primary) {
  ExecutorOptions options;
  options.primary = primary;
  options.validation = "sync";
  options.profile.rays = "packets";
  options.pack.acceleration = Acceleration::bvh;
  const auto executor = make_executor(Backend::gpu, scene, options);
  std::vector<PixelSample> all;
  for (uint32_t index = 0; index < side * side; ++index) {
    // In two tiles, of which the second is no whole number of blocks away.
    for (const Rect tile : {Rect{0, 0, width, 13}, Rect{0, 13, width, height - 13}}) {
      std::vector<PixelSample> some(size_t(tile.pixels()));
      REQUIRE(executor->sample(tile, index, some));
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

}  // namespace

TEST_CASE("what is drawn at a sample's place is what its eye ray hits") {
  const Scene scene = triangles_and_spheres();
  pack::PackOptions options;
  options.acceleration = Acceleration::bvh;
  const records::PackedScene packed = pack::pack(scene, options);
  gpu::Device device({.draws = true});
  PrimaryRaster raster(device, scene, packed);

  // The places of 2 × 2 samples are the middles of the pixels of a picture twice as large.
  const Scene larger = triangles_and_spheres(side);
  std::vector<FirstHit> hits(size_t(side * width) * size_t(side * height));
  make_executor(Backend::twin, larger, {})->first_hits({0, 0, side * width, side * height}, hits);

  int different = 0, triangles = 0, nothing = 0, spheres = 0;
  for (int index = 0; index < side * side; ++index) {
    raster.draw(uint32_t(index));
    const auto drawn = raster.drawn().read_records<uint32_t>(size_t(width) * height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int column = side * x + index % side, row = side * y + index / side;
        const FirstHit& hit = hits[size_t(row) * size_t(side * width) + size_t(column)];
        const uint32_t what = drawn[size_t(y) * width + size_t(x)];
        const bool triangle = what != DRAWN_NOTHING && what != DRAWN_OTHER;
        const bool hits_sphere = hit.primitive >= 0 && hit.primitive % 8 == 0;
        const bool same = triangle              ? int32_t(packed.primitives[what - 1].id) == hit.primitive
                          : what == DRAWN_OTHER ? hits_sphere
                                                : hit.primitive < 0;
        different += same ? 0 : 1;
        ++(triangle ? triangles : what == DRAWN_NOTHING ? nothing : spheres);
      }
    }
  }
  CAPTURE(different);
  CHECK(different <= side * side * width * height / 500);
  CHECK(std::min({triangles, nothing, spheres}) > 100);
}

TEST_CASE("pictures that start from what is drawn are those of traced eye rays, but at edges") {
  Scene scene = triangles_and_spheres();
  for (const auto integrator : {IntegratorType::raycast, IntegratorType::whitted, IntegratorType::path}) {
    CAPTURE(int(integrator));
    scene.render.integrator = integrator;
    const std::vector<PixelSample> traced = samples_of(scene, PrimaryRays::trace);
    const std::vector<PixelSample> drawn = samples_of(scene, PrimaryRays::raster);
    size_t different = 0;
    for (size_t i = 0; i < traced.size(); ++i) {
      const bool same = traced[i].color == drawn[i].color && traced[i].rays == drawn[i].rays &&
                        traced[i].hits == drawn[i].hits && traced[i].flags == drawn[i].flags;
      different += same ? 0 : 1;
    }
    CAPTURE(different);
    CHECK(different <= traced.size() / 500);
  }
}

TEST_CASE("one-sided meshes are drawn from their front alone, mirrored ones too") {
  const Scene scene = one_sided_squares();
  for (const PrimaryRays primary : {PrimaryRays::trace, PrimaryRays::raster}) {
    CAPTURE(int(primary));
    const std::vector<PixelSample> samples = samples_of(scene, primary);
    int wrong = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
      const int x = int(i) % width, y = int(i) / width % height;
      if (x == width / 2 || y == height / 2) continue;  // where squares meet
      const Vec3& color = samples[i].color;
      wrong += color.x == color.z || (color.x > color.z) != (y < height / 2);
    }
    CHECK(wrong == 0);
  }
}
