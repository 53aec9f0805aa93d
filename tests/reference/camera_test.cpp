#include "host/reference/camera.hpp"
#include "host/cameras/make.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"
#include "host/scene/integrator.hpp"
#include "tests/support/empty_scene.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::cameras;
using namespace eyeray::engine::test;

namespace {

Camera looking_along_z(const PerspectiveCamera& values) {
  return {.eye = {0, 0, 5}, .target = {0, 0, 0}, .projection = make_projection(values)};
}

}  // namespace

TEST_CASE("row 0 is the top and column 0 the left") {
  const Camera camera = looking_along_z(PerspectiveCamera{90});
  const reference::CameraRays rays(camera, {.width = 200, .height = 100});
  CHECK(near(rays.ray({100, 50}).d, Vec3(0, 0, -1), 1e-15));
  CHECK(near(rays.ray({0, 50}).d, glm::normalize(Vec3(-1, 0, -1)), 1e-15));
  CHECK(near(rays.ray({200, 50}).d, glm::normalize(Vec3(1, 0, -1)), 1e-15));
  CHECK(near(rays.ray({100, 0}).d, glm::normalize(Vec3(0, 0.5, -1)), 1e-15));
  CHECK(near(rays.ray({200, 100}).d, glm::normalize(Vec3(1, -0.5, -1)), 1e-15));
}

TEST_CASE("the field of view is measured along its axis") {
  // A 300 × 400 picture has a diagonal of 500; tan(α/2) = 1 along the axis.
  const auto half_width = [](FovAxis axis, int width, int height) {
    const Camera camera = looking_along_z(PerspectiveCamera{90, axis});
    const Vec3 d =
        reference::CameraRays(camera, {.width = width, .height = height}).ray({width, height / 2.0}).d;
    return d.x / -d.z;
  };
  CHECK(half_width(FovAxis::horizontal, 300, 400) == doctest::Approx(1));
  CHECK(half_width(FovAxis::vertical, 300, 400) == doctest::Approx(0.75));
  CHECK(half_width(FovAxis::shorter, 300, 400) == doctest::Approx(1));
  CHECK(half_width(FovAxis::shorter, 400, 300) == doctest::Approx(4.0 / 3));
  CHECK(half_width(FovAxis::diagonal, 300, 400) == doctest::Approx(0.6));
}

TEST_CASE("an orthographic camera moves the origin") {
  const Camera camera{
      .eye = {1, 2, 5}, .target = {1, 2, 0}, .projection = make_projection(OrthographicCamera{3})};
  const reference::CameraRays rays(camera, {.width = 200, .height = 100});
  CHECK(near(rays.ray({0, 0}).o, Vec3(1 - 3, 2 + 1.5, 5), 1e-14));
  CHECK(near(rays.ray({150, 50}).o, Vec3(1 + 1.5, 2, 5), 1e-14));
  CHECK(rays.ray({0, 0}).d == Vec3(0, 0, -1));
}

TEST_CASE("a fisheye's distance from the centre is proportional to the angle, up to its circle") {
  const Camera camera{.eye = {0, 0, 5}, .projection = make_projection(FisheyeCamera{240})};
  const reference::CameraRays rays(camera, {.width = 200, .height = 100});
  const double third = M_PI / 3;  // the angle at 25 pixels; at 50 it is 120°
  CHECK(near(rays.ray({100, 50}).d, Vec3(0, 0, -1), 1e-15));
  CHECK(near(rays.ray({125, 50}).d, Vec3(std::sin(third), 0, -std::cos(third)), 1e-15));
  CHECK(near(rays.ray({100, 0}).d, Vec3(0, std::sin(2 * third), -std::cos(2 * third)), 1e-15));
  CHECK(rays.sees({149, 50}));
  CHECK_FALSE(rays.sees({151, 50}));
  CHECK_FALSE(rays.sees({140, 10}));
  const Camera across{.projection = make_projection(FisheyeCamera{240, FovAxis::horizontal})};
  CHECK(reference::CameraRays(across, {.width = 200, .height = 100}).sees({180, 50}));
}

TEST_CASE("a panorama maps pixels to longitude and latitude, a cylinder to longitude and height") {
  const ImageSettings image{.width = 400, .height = 200};
  const Camera sphere{.eye = {0, 0, 5}, .projection = make_projection(PanoramaCamera{})};
  const reference::CameraRays all(sphere, image);
  CHECK(near(all.ray({200, 100}).d, Vec3(0, 0, -1), 1e-15));
  CHECK(near(all.ray({300, 100}).d, Vec3(1, 0, 0), 1e-15));
  CHECK(near(all.ray({0, 100}).d, Vec3(0, 0, 1), 1e-15));
  CHECK(near(all.ray({77, 0}).d, Vec3(0, 1, 0), 1e-15));
  CHECK(near(all.ray({250, 150}).d, Vec3(0.5, -std::sqrt(0.5), -0.5), 1e-15));
  const Camera wrapped{.eye = {0, 0, 5}, .projection = make_projection(CylindricalCamera{360})};
  const reference::CameraRays around(wrapped, image);
  CHECK(near(around.ray({300, 100}).d, Vec3(1, 0, 0), 1e-15));
  CHECK(near(around.ray({300, 0}).d, glm::normalize(Vec3(1, M_PI / 2, 0)), 1e-15));
}

TEST_CASE("rays through a lens intersect in the plane in focus") {
  PerspectiveCamera values{70};
  const Vec2 position(130, 20);
  const auto rays = [&] {
    return reference::CameraRays(looking_along_z(values), {.width = 200, .height = 100});
  };
  const Ray pinhole = rays().ray(position);
  values.aperture = {.radius = 0.5, .focus = 3};
  for (const Vec2& u : {Vec2(0.1, 0.2), Vec2(0.9, 0.4), Vec2(0.5, 0.99)}) {
    for (const int blades : {0, 3, 6}) {
      values.aperture.blades = blades;
      const Vec2 lens = rays().lens_point(u);
      CHECK(glm::length(lens) <= 0.5);
      const Ray ray = rays().ray(position, lens);
      CHECK(near(ray.o, Vec3(lens, 5), 1e-15));
      CHECK(glm::length(ray.d) == doctest::Approx(1).epsilon(1e-14));
      CHECK(near(ray.o - 3 / ray.d.z * ray.d, pinhole.o - 3 / pinhole.d.z * pinhole.d, 1e-13));
    }
  }
  // The aperture's first corner is at the right, and the next one is above.
  values.aperture.blades = 4;
  CHECK(near(Vec3(rays().lens_point({0, 1}), 0), Vec3(0.5, 0, 0), 1e-15));
  CHECK(near(Vec3(rays().lens_point({0.25, 1}), 0), Vec3(0, 0.5, 0), 1e-15));
}

TEST_CASE("a known picture is upright") {
  // Red is to the right of the middle, green above it, and blue to its left.
  Scene scene = test::empty_scene();
  scene.image = {.width = 9, .height = 9};
  scene.camera = looking_along_z(PerspectiveCamera{90});
  scene.render.integrator = IntegratorType::raycast;
  const auto ball = [&](const Vec3& center, const Vec3& color) {
    add(scene, make_sphere(center, 0.6), add(scene, make_phong({.diffuse = textures::make_constant(color)})));
  };
  ball({3, 0, 0}, {1, 0, 0});
  ball({0, 3, 0}, {0, 1, 0});
  ball({-3, 0, 0}, {0, 0, 1});
  const reference::Renderer renderer(scene);
  const auto pixel = [&](int x, int y) {
    return glm::greaterThan(renderer.sample(x, y, 0).color, Vec3(0.1));
  };
  using Bools = glm::bvec3;
  CHECK(pixel(7, 4) == Bools(true, false, false));
  CHECK(pixel(4, 1) == Bools(false, true, false));
  CHECK(pixel(1, 4) == Bools(false, false, true));
  CHECK(pixel(4, 7) == Bools(false));

  // A shift of two pixels moves the ray, but the result is still that of pixel (5, 4).
  CHECK(renderer.first_hit(5, 4, {2, 0}).primitive == 0);
  CHECK(renderer.sample(5, 4, 0, {2, 0}).color == renderer.sample(7, 4, 0).color);
}

TEST_CASE("random numbers are the published PCG hash") {
  // Values computed by an independent program.
  CHECK(reference::random(0, 0, 0, 0) == 9253448 / 16777216.0);
  CHECK(reference::random(1, 0, 0, 0) == 11179986 / 16777216.0);
  CHECK(reference::random(7, 5, 1, 42) == 2373789 / 16777216.0);
  CHECK(reference::random(4294967295u, 3, 1, 99) == 6931156 / 16777216.0);
}

TEST_CASE("samples lie in the cells of n × n, in order") {
  ImageSettings image{.width = 5, .height = 3, .samples = 9};
  CHECK(near(reference::sample_position(image, 0, 2, 1, 0).x, 1 / 6.0, 1e-15));
  CHECK(near(reference::sample_position(image, 0, 2, 1, 5).x, 5 / 6.0, 1e-15));
  CHECK(near(reference::sample_position(image, 0, 2, 1, 5).y, 3 / 6.0, 1e-15));

  image.pattern = SamplePattern::jittered;
  Vec2 mean(0);
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (uint32_t s = 0; s < 9; ++s) {
        const Vec2 in_cell = reference::sample_position(image, 7, x, y, s) * 3.0 - Vec2(s % 3, s / 3);
        CHECK(in_cell.x >= 0);
        CHECK(in_cell.y >= 0);
        CHECK(in_cell.x < 1);
        CHECK(in_cell.y < 1);
        mean += in_cell / 135.0;
      }
    }
  }
  CHECK(near(mean.x, 0.5, 0.1));
  CHECK(near(mean.y, 0.5, 0.1));
  CHECK(reference::sample_position(image, 7, 1, 1, 0) != reference::sample_position(image, 8, 1, 1, 0));
  CHECK(reference::sample_position(image, 7, 1, 1, 0) != reference::sample_position(image, 7, 2, 1, 0));
}
