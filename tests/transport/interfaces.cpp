// Borders between media of one index, which refract nothing: light passes them, weakened by the media in
// between. The expectations are closed forms.
#include "patch.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("interfaces: the light of a sun and of a point is absorbed by the Beer-Lambert law") {
  const double sun = 0.5, slanted = std::sqrt(2.0), absorption = 0.3;
  for (const bool inside : {false, true}) {
    CAPTURE(inside);
    Scene scene = floor(16);
    const double low = inside ? -1 : 1;
    add(scene, make_box({-50, low, -50}, {50, 2, 50}),
        add(scene, make_dielectric({.ior = 1, .absorption = Vec3(absorption)})));
    const double height = inside ? 2 : 1;
    const double to_eye = inside ? std::exp(-absorption * glm::length(scene.camera.eye)) : 1;
    add_point_light(scene, {0, 3, 0}, Vec3(3), Falloff::inverse_square);
    const double by_point = albedo * 3 / 9 * std::exp(-absorption * height) * to_eye;
    check(scene, by_point, 1e-4);
    add_sun(scene, {0, 1, 1}, Vec3(sun));
    scene.image.samples = 256;
    check(scene, by_point + albedo * sun / slanted * std::exp(-absorption * height * slanted) * to_eye, 1e-4);
  }
}

// The share `transmission` · (1 - metallic) · color² crosses both borders of a slab. The other shares block
// light, or reflect it.
TEST_CASE("interfaces of principled materials tint the light of suns and points, and do not blur it") {
  constexpr double absorption = 0.3, slab = 0.5;
  for (const double roughness : {0.0, 0.6}) {
    CAPTURE(roughness);
    Scene scene = floor(1024);
    add(scene, make_box({-50, 1, -50}, {50, 1 + slab, 50}),
        add(scene, make_principled({.color = gray(0.9),
                                    .metallic = gray(0.25),
                                    .roughness = gray(roughness),
                                    .ior = 1,
                                    .transmission = gray(0.5),
                                    .absorption = Vec3(absorption)})));
    add_point_light(scene, {0, 3, 0}, Vec3(3), Falloff::inverse_square);
    add_sun(scene, {0, 1, 0}, Vec3(0.5));
    scene.camera.eye = {0.1, 0.25, 0.1};
    const double border = 0.9 * 0.5 * 0.75;
    check(scene, albedo * (3.0 / 9 + 0.5) * border * border * std::exp(-absorption * slab), 1e-4);
  }
}

TEST_CASE("interfaces under a coat lose at each border the light that the coat reflects") {
  Scene scene = floor(16);
  add(scene, make_box({-50, 1, -50}, {50, 1.5, 50}),
      add(scene, make_principled({.color = gray(1), .ior = 1, .transmission = gray(1), .coat = gray(1)})));
  add_sun(scene, {0, 1, 0}, Vec3(0.5));
  scene.camera.eye = {0.1, 0.25, 0.1};
  check(scene, albedo * 0.5 * 0.96 * 0.96, 1e-3);
}

// ∫ σₛ / 4π · e^(−σₜ t) · e^(−σₜ h) · π I dt through a box of depth 2, at h = 1 below its top.
TEST_CASE("interfaces: a box of air scatters a sun's light once as its integral gives") {
  const double scattering = 0.3, extinction = 0.4, sun = 2;
  Scene scene = patch({0, 0, 3}, {0, 0, 0}, 1024);
  add(scene, make_box({-1, -1, -1}, {1, 1, 1}),
      add(scene, make_dielectric({.ior = 1, .absorption = Vec3(0.1), .scattering = Vec3(scattering)})));
  add_sun(scene, {0, 1, 0}, Vec3(sun));
  check(scene, scattering * sun / 4 * std::exp(-extinction) * (1 - std::exp(-2 * extinction)) / extinction,
        1e-4);
}

TEST_CASE("interfaces transmit all light of an area light, whichever strategy finds it") {
  for (const int slabs : {1, 6}) {
    CAPTURE(slabs);
    Scene scene = floor(slabs == 6 ? 2560 : 256);
    scene.render.max_depth = slabs == 6 ? 1 : 0;
    scene.camera.eye = {0.1, 0.25, 0.1};
    const int air = add(scene, make_dielectric({.ior = 1}));
    for (int i = 0; i < slabs; ++i)
      add(scene, make_box({-50, 0.3 + 0.1 * i, -50}, {50, 0.35 + 0.1 * i, 50}), air);
    add(scene, make_sphere({0, 2, 0}, 1), emissive(scene));
    check(scene, shown(M_PI / 4), 1e-4);
  }
}
