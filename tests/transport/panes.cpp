// Panes, through which paths go straight, and frosted glass: compared with known answers.
#include "patch.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("panes reflect R' = 2R / (1 + R) and transmit the rest straight on, to the eye and from lights") {
  const double r = 0.04, mirrored = 2 * r / (1 + r), through = 1 - mirrored;
  Scene furnace = patch({0, 0, 4}, {0.3, 0.4, 0}, 64);
  furnace.render.background = Vec3(1);
  furnace.render.max_depth = 64;
  add(furnace, make_sphere({0, 0, 0}, 1), add(furnace, make_dielectric({.thin = true})));
  check(furnace, 1, 1e-5);

  Scene seen = patch({0, 0, 4}, {0, 0, 0}, 256);
  const int window = add(seen, make_dielectric({.thin = true}));
  for (const double z : {0.0, 1.0}) add(seen, make_disk({0, 0, z}, {0, 0, 1}, 1), window);
  add(seen, make_disk({0, 0, -1}, {0, 0, 1}, 1), emissive(seen));
  // Light goes to and fro between the two panes.
  seen.render.max_depth = 64;
  check(seen, through * through / (1 - mirrored * mirrored), 1e-5);

  // The light of a point through one pane, at normal incidence: T'. A tinted pane's T' depends on its layer.
  Scene lit = floor(16);
  add_point_light(lit, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  Scene tinted = floor(16);
  add_point_light(tinted, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  add(lit, make_disk({0, 1.5, 0}, {0, 1, 0}, 0.1), add(lit, make_dielectric({.thin = true})));
  check(lit, albedo * 3 / 4 * through, 1e-4);
  add(tinted, make_disk({0, 1.5, 0}, {0, 1, 0}, 0.1),
      add(tinted, make_principled(
                      {.color = gray(0.5), .roughness = gray(0), .transmission = gray(1), .thin = true})));
  check(tinted, albedo * 3 / 4 * 0.5 * 0.96, 1e-3);

  // All the light of an area light comes through nine panes like through eight, whichever strategy finds it.
  for (const int panes : {1, 8, 9}) {
    CAPTURE(panes);
    Scene behind = floor(panes == 9 ? 2560 : 256);
    behind.render.max_depth = 0;
    const int clear = add(behind, make_dielectric({.ior = 1, .thin = true}));
    for (int i = 0; i < panes; ++i) add(behind, make_disk({0, 0.3 + 0.05 * i, 0}, {0, 1, 0}, 3), clear);
    behind.camera.eye = {0.1, 0.25, 0.1};
    add(behind, make_sphere({0, 2, 0}, 1), emissive(behind));
    if (panes == 9) behind.render.max_depth = 1;
    check(behind, shown(M_PI / 4), 1e-4);
  }
}

TEST_CASE("panes: light of point lights and suns passes any number of them") {
  for (const int panes : {8, 9, 40}) {
    CAPTURE(panes);
    Scene behind = floor(256);
    behind.camera.eye = {0.1, 0.25, 0.1};
    const int clear = add(behind, make_dielectric({.ior = 1, .thin = true}));
    for (int i = 0; i < panes; ++i) add(behind, make_disk({0, 0.3 + 0.01 * i, 0}, {0, 1, 0}, 9), clear);
    add_point_light(behind, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
    add_sun(behind, {0, 1, 1}, Vec3(0.5));
    check(behind, albedo * (3.0 / 4 + 0.5 * std::sqrt(0.5)));
  }
}

TEST_CASE("frosted glass and frosted panes lose no light in a furnace") {
  for (const bool thin : {false, true}) {
    CAPTURE(thin);
    Scene ball = patch({0, 0, 4}, {0.3, 0.4, 0}, 144);
    ball.render.background = Vec3(1);
    ball.render.max_depth = 128;
    add(ball, make_sphere({0, 0, 0}, 1),
        add(ball, make_principled(
                      {.color = gray(1), .roughness = gray(0.6), .transmission = gray(1), .thin = thin})));
    check(ball, 1, 0.01);
  }
}
