// Light that comes straight from the lights, the surroundings and the background.
#include "host/scene/integrator.hpp"
#include "tests/support/scenes.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using namespace eyeray::engine::materials;
using namespace eyeray::engine::test;

namespace {

// A floor at y = 0 of `material`, seen from `eye` at the origin.
Scene floor_seen_from(const Vec3& eye, std::unique_ptr<Material> material) {
  Scene scene = one_pixel(eye, {0, 0, 0});
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, std::move(material)));
  return scene;
}

}  // namespace

TEST_CASE("a ray that hits nothing sees the background") {
  Scene scene = one_pixel({0, 0, 5}, {0, 0, 0});
  scene.render.background = {0.34, 0.55, 0.85};
  for (const IntegratorType integrator : {IntegratorType::whitted, IntegratorType::raycast}) {
    scene.render.integrator = integrator;
    const PixelSample sample = look(scene);
    CHECK(sample.color == Vec3(0.34, 0.55, 0.85));
    CHECK(sample.rays == 1);
    CHECK(sample.hits == 0);
    CHECK(sample.flags == 0);
  }
}

TEST_CASE("ambient light is weighted by ambient, or else by diffuse") {
  Scene scene = floor_seen_from({0, 1, 3}, make_phong({.diffuse = gray(0.5)}));
  scene.render.ambient = {0.4, 0.2, 0.1};
  CHECK(near(look(scene).color, Vec3(0.2, 0.1, 0.05), 1e-15));
  scene.materials[0] = make_phong({.diffuse = gray(0.5), .ambient = gray(1)});
  CHECK(near(look(scene).color, Vec3(0.4, 0.2, 0.1), 1e-15));
}

TEST_CASE("diffuse light follows the cosine, and a point light the square of the distance") {
  Scene scene = floor_seen_from({0, 1, 3}, make_phong({.diffuse = gray(0.8)}));
  add_sun(scene, {std::sqrt(3.0), 1, 0}, {3, 2, 1});
  PixelSample sample = look(scene);
  CHECK(near(sample.color, 0.4 * Vec3(3, 2, 1), 1e-14));
  CHECK(sample.rays == 2);
  CHECK(sample.hits == 1);

  scene.lights.clear();
  add_point_light(scene, {0, 3, 4}, Vec3(10), Falloff::inverse_square);
  CHECK(near(look(scene).color, Vec3(0.8 * 10 / 25 * 0.6), 1e-14));
  scene.lights.clear();
  add_point_light(scene, {0, 3, 4}, Vec3(10), Falloff::none);
  CHECK(near(look(scene).color, Vec3(0.8 * 10 * 0.6), 1e-14));
}

TEST_CASE("only the visible side of a surface is lit") {
  Scene scene = floor_seen_from({0, -1, 3}, make_phong({.diffuse = gray(1)}));
  add_sun(scene, {0, 1, 0}, Vec3(1));
  PixelSample sample = look(scene);
  CHECK(sample.color == Vec3(0));
  CHECK(sample.rays == 1);  // no shadow ray goes to a light that is behind
  scene.lights.clear();
  add_sun(scene, {0, -1, 0}, Vec3(1));
  CHECK(look(scene).color == Vec3(1));
}

TEST_CASE("highlights: Phong's lobe is around the mirrored light, Blinn's around the half vector") {
  // View from 30° off the normal, light at 20° on the other side: 10° between r and v, 5° between n and h.
  const auto at = [](double degrees) {
    return Vec3(0, std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
  };
  const auto highlight = [&](bool blinn, double view, double light) {
    const Highlight lobe{gray(0.5), 40, blinn};
    Scene scene = floor_seen_from(4.0 * at(view), make_phong({.diffuse = gray(0), .highlight = lobe}));
    add_sun(scene, at(light), Vec3(2));
    return look(scene).color.x;
  };
  CHECK(highlight(false, 30, -30) == doctest::Approx(1));
  CHECK(highlight(true, 30, -30) == doctest::Approx(1));
  CHECK(highlight(false, 30, -20) == doctest::Approx(std::pow(std::cos(glm::radians(10.0)), 40)));
  CHECK(highlight(true, 30, -20) == doctest::Approx(std::pow(std::cos(glm::radians(5.0)), 40)));
  CHECK(highlight(false, 80, 80) == 0);  // r·v < 0
}

TEST_CASE("shadow rays lose their light to each shape that they hit") {
  Scene scene = floor_seen_from({0, 1, 3}, make_phong({.diffuse = gray(1)}));
  add_point_light(scene, {0, 10, 0}, Vec3(1));
  const int opaque = add(scene, make_phong({}));
  const int glass = add(scene, make_dielectric({.ior = 1.5}));
  const int film = add(scene, make_dielectric({.ior = 2, .shadow = 0.5}));
  add(scene, make_sphere({0, 5, 0}, 1), glass);
  CHECK(near(look(scene).color, Vec3(0.96), 1e-14));
  CHECK(look(scene).rays == 2);
  add(scene, make_sphere({0, 8, 0}, 0.5), film);
  CHECK(near(look(scene).color, Vec3(0.96 * 0.5), 1e-14));
  scene.shapes.back()->material = opaque;
  CHECK(look(scene).color == Vec3(0));

  // An object behind the light or behind the floor casts no shadow.
  scene.lights.clear();
  add_point_light(scene, {0, 7, 0}, Vec3(1));
  CHECK(near(look(scene).color, Vec3(0.96), 1e-14));
  add(scene, make_sphere({0, -2, 0}, 1), opaque);
  CHECK(near(look(scene).color, Vec3(0.96), 1e-14));

  // A light inside the glass is dimmed like a light behind the glass.
  scene.lights.clear();
  add_point_light(scene, {0, 5, 0}, Vec3(1));
  CHECK(near(look(scene).color, Vec3(0.96), 1e-14));
}

TEST_CASE("checks follow the uv") {
  const TexturePtr checks = textures::make_checker(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec2(2, 1));
  Scene scene = floor_seen_from({0, 1, 3}, make_phong({.diffuse = gray(0), .ambient = checks}));
  scene.render.ambient = Vec3(1);
  const auto at = [&](double x, double z) {
    scene.camera.target = {x, 0, z};
    return look(scene).color;
  };
  // On this floor, v = −z.
  CHECK(at(0.5, -0.5) == Vec3(1, 0, 0));
  CHECK(at(1.5, -0.5) == Vec3(1, 0, 0));
  CHECK(at(2.5, -0.5) == Vec3(0, 0, 1));
  CHECK(at(0.5, -1.5) == Vec3(0, 0, 1));
  CHECK(at(0.5, 0.5) == Vec3(0, 0, 1));
  CHECK(at(-0.5, 0.5) == Vec3(1, 0, 0));
}

TEST_CASE("raycast has no shadows and no reflections, and a light at the eye if there is no other") {
  Scene scene = floor_seen_from({0, 3, 4}, make_mirror({.reflectance = gray(0.5)}));
  scene.render.integrator = IntegratorType::raycast;
  CHECK(near(look(scene).color, Vec3(0.5 * 0.6), 1e-15));
  add_sun(scene, {0, 4, 3}, Vec3(2));
  add(scene, make_sphere({0, 4, 3}, 0.1), 0);
  scene.render.ambient = Vec3(0.1);
  const PixelSample sample = look(scene);
  CHECK(near(sample.color, Vec3(0.5 * (0.1 + 2 * 0.8)), 1e-15));
  CHECK(sample.rays == 1);
  CHECK(sample.hits == 1);

  // A light behind the surface, or exactly at the visible point, contributes nothing.
  scene.lights.clear();
  add_sun(scene, {0, -1, 0}, Vec3(2));
  CHECK(near(look(scene).color, Vec3(0.05), 1e-15));
  scene.lights.clear();
  add_point_light(scene, {0, 0, 0}, Vec3(1), Falloff::inverse_square);
  scene.camera.eye = {0, 3, 0};
  scene.camera.up = {1, 0, 0};
  CHECK(near(look(scene).color, Vec3(0.05), 1e-15));
}
