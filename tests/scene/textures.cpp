// Image textures as pictures show them: the GPU and the twin bit by bit, and both against the reference.
#include <fmt/format.h>

#include "frames.hpp"
#include "host/cameras/make.hpp"
#include "host/lights/make.hpp"
#include "host/materials/make.hpp"
#include "host/shapes/make.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::compare;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::lights;
using namespace eyeray::engine::cameras;
using namespace eyeray::engine::test;

namespace {

std::shared_ptr<const ImageTexture> random_image(Random& random) {
  const auto image = std::make_shared<ImageTexture>();
  constexpr int sizes[] = {1, 2, 5, 16, 33};
  image->width = sizes[random.below(5)];
  image->height = sizes[random.below(5)];
  for (int i = 0; i < image->width * image->height; ++i) {
    const uint64_t bits = random.bits();
    image->texels.push_back({uint8_t(bits), uint8_t(bits >> 8), uint8_t(bits >> 16), uint8_t(bits >> 24)});
  }
  image->srgb = random.below(2) == 0;
  image->filter = Filter(random.below(2));
  image->wrap_u = Wrap(random.below(3));
  image->wrap_v = Wrap(random.below(3));
  return image;
}

// Squares side by side before an orthographic camera. Each has its own image at random positions in uv, near
// 0 and far from it. One in five also mirrors, with a second image as its reflectance.
Scene patchwork(Random& random, int across, int down) {
  Scene scene = test::empty_scene();
  scene.image = {.width = 24 * across, .height = 24 * down};
  scene.camera.projection = make_projection(OrthographicCamera{0.5 * across});
  // The camera is slightly displaced, so that no pixel's centre lies on an edge.
  scene.camera.target = {0.5 * across + 0.0131, 0.5 * down + 0.0073, 0};
  scene.camera.eye = scene.camera.target + Vec3(0, 0, 5);
  scene.render.ambient = Vec3(0.25);
  scene.lights.push_back(make_light(PointLight{.position = {3, 4, 9}, .intensity = Vec3(60)}));
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const Vec3 tint{random.uniform(), random.uniform(), 1};
      const auto image = random_image(random);
      const Vec2 size{random.log_uniform(0.5, 2), random.log_uniform(0.5, 2)};
      PhongValues values{.diffuse = textures::make_image(image, tint, {.size = size})};
      if (random.below(3) == 0) values.ambient = textures::make_constant(Vec3(0.5));
      if (random.below(3) == 0)
        values.highlight.specular = textures::make_checker(Vec3(1), Vec3(0.2), Vec2(0.3));
      if (random.below(5) == 0) values.reflectance = textures::make_image(random_image(random), Vec3(0.6));
      scene.materials.push_back(make_phong(values));

      // About three images a square, some upside down or mirrored.
      const Vec2 start(random.uniform(-20, 20), random.uniform(-20, 20));
      const Vec2 u(random.uniform(-3, 3), random.uniform(-1, 1)),
          v(random.uniform(-1, 1), random.uniform(-3, 3));
      const Vec3 corner(x, y, 0);
      for (const bool upper : {false, true}) {
        TriangleValues triangle;
        triangle.vertices = {corner + Vec3(upper, upper, 0), corner + Vec3(!upper, upper, 0),
                             corner + Vec3(upper, !upper, 0)};
        triangle.uv = {start + double(upper) * (u + v), start + double(!upper) * u + double(upper) * v,
                       start + double(upper) * u + double(!upper) * v};
        scene.shapes.push_back(make_triangle(triangle));
        scene.shapes.back()->material = int(scene.materials.size()) - 1;
      }
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("random images: the GPU agrees with the twin bit by bit, with the reference within tolerance") {
  Random random(11);
  int pixels = 0;
  int explained = 0;
  for (const auto& [across, down] : {std::pair{3, 3}, {3, 3}, {9, 7}}) {
    const Scene scene = patchwork(random, across, down);
    const Frame twin = render_frame(scene, Backend::twin);
    for (const bool constants : {true, false})
      for (const char* loads : {"texels", "storage"}) {
        CAPTURE(constants);
        CAPTURE(loads);
        ExecutorOptions options;
        options.gpu.constants = constants;
        options.gpu.profile.loads = loads;
        const ExactComparison bits = compare_exactly(render_frame(scene, Backend::gpu, options), twin);
        CHECK(bits.different_pixels == 0);
        CHECK(bits.passes(0));
      }
    const ReferenceComparison reference = test::compare_with_reference(scene, twin);
    CHECK(reference.first_hits.passes());
    CHECK(reference.colors.unexplained == 0);
    CHECK(reference.colors.passes());
    pixels += int(reference.colors.pixels);
    explained += int(reference.colors.explained_pixels());
  }
  MESSAGE(fmt::format("{} pixels, {} of them explained", pixels, explained));
}

TEST_CASE("more texels than a storage buffer holds are read as texel buffers, or refused with the numbers") {
  Random random(1);
  Scene scene = patchwork(random, 1, 1);
  const auto image = std::make_shared<ImageTexture>();
  image->width = 1 << 13;
  image->height = (1 << 12) + 1;
  image->texels.resize(size_t(image->width) * size_t(image->height));
  scene.materials[0] = make_phong({.diffuse = textures::make_image(image)});
  image->texels.back() = {255, 128, 0, 255};
  const Frame twin = render_frame(scene, Backend::twin);
  for (const std::string loads : {"texels", "storage"}) {
    CAPTURE(loads);
    ExecutorOptions options;
    options.gpu.profile.loads = loads;
    try {
      const Frame gpu = render_frame(scene, Backend::gpu, options);
      CHECK(compare_exactly(gpu, twin).different_pixels == 0);
    } catch (const Error& error) {
      CHECK(loads == "storage");
      CHECK(error.code() == ExitCode::no_device);
      CHECK(std::string(error.what()).find("'texels' has 134252544 bytes") != std::string::npos);
    }
  }
}
