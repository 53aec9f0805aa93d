// Surfaces of alpha_mode "blend": under every integrator, pictures equal on average those of alpha
// compositing (Porter and Duff, "Compositing Digital Images", SIGGRAPH 1984).
#include "patch.hpp"
#include "tests/support/meshes.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// A material that blends, and is black except for its own light.
int blended(Scene& scene, double alpha, double radiance = 0) {
  const int made = emissive(scene, radiance);
  scene.materials[size_t(made)]->mask = AlphaMask{.alpha = gray(alpha), .blends = true};
  return made;
}

constexpr IntegratorType all[] = {IntegratorType::raycast, IntegratorType::whitted, IntegratorType::path};
constexpr IntegratorType with_shadows[] = {IntegratorType::whitted, IntegratorType::path};

}  // namespace

TEST_CASE("blended layers cover each other and the background") {
  for (const IntegratorType integrator : all) {
    CAPTURE(int(integrator));
    Scene scene = patch({0, 0, 4}, {0, 0, 0}, 4096);
    scene.render.integrator = integrator;
    scene.render.background = Vec3(2);
    add(scene, make_disk({0, 0, 0}, {0, 0, 1}, 1), blended(scene, 0.5, 3));
    add(scene, make_disk({0, 0, 1}, {0, 0, 1}, 1), blended(scene, 0.25, 1));
    add(scene, make_disk({0, 0, -1}, {0, 0, 1}, 1), blended(scene, 0.8, 0.5));
    check(scene, 0.25 * 1 + 0.75 * (0.5 * 3 + 0.5 * (0.8 * 0.5 + 0.2 * 2)));
  }
}

TEST_CASE("an alpha of 0 is never hit, and one of 1 always") {
  for (const IntegratorType integrator : all) {
    for (const double alpha : {0.0, 1.0}) {
      CAPTURE(int(integrator));
      CAPTURE(alpha);
      Scene scene = patch({0, 0, 4}, {0, 0, 0}, 256);
      scene.render.integrator = integrator;
      scene.render.background = Vec3(2);
      add(scene, make_disk({0, 0, 0}, {0, 0, 1}, 1), blended(scene, alpha, 3));
      check(scene, alpha == 1 ? 3 : 2);
    }
  }
}

TEST_CASE("instances of one mesh blend independently of each other") {
  for (const IntegratorType integrator : all) {
    CAPTURE(int(integrator));
    Scene scene = patch({0.1, 0.2, 4}, {0.1, 0.2, 0}, 4096);
    scene.render.integrator = integrator;
    scene.render.background = Vec3(1);
    Mesh square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.colors.assign(4, Vec3(1));
    square.alphas = {0.5, 0.5, 0.5, 0.5};  // multiplied by the material's alpha
    const int mesh = add(scene, std::move(square));
    const int material = blended(scene, 0.8);
    for (const double z : {0.0, -1.0, -2.0}) add_instance(scene, mesh, material, translation({0, 0, z}));
    check(scene, 0.6 * 0.6 * 0.6);
  }
}

TEST_CASE("blended layers transmit light to a floor that is seen directly or through the same layers") {
  for (const IntegratorType integrator : with_shadows) {
    CAPTURE(int(integrator));
    for (const bool seen_through : {false, true}) {
      CAPTURE(seen_through);
      Scene scene = floor(8192);
      scene.render.integrator = integrator;
      if (seen_through) scene.camera.eye = {0.4, 4, 0.5};
      add_sun(scene, {0, 1, 0}, Vec3(0.5));
      for (const auto& [y, alpha] : {std::pair(2.0, 0.25), {3.0, 0.5}})
        add(scene, make_disk({0, y, 0}, {0, 1, 0}, 9), blended(scene, alpha));
      const double through = 0.75 * 0.5;
      check(scene, albedo * 0.5 * through * (seen_through ? through : 1));
    }
  }
}

TEST_CASE("a mirror shows blended layers, and reflected rays decide anew whether to hit them") {
  for (const IntegratorType integrator : with_shadows) {
    CAPTURE(int(integrator));
    Scene scene = patch({0, 0, 4}, {0, 0, 0}, 4096);
    scene.render.integrator = integrator;
    scene.render.max_depth = 3;
    scene.render.background = Vec3(1);
    add(scene, make_disk({0, 0, -1}, {0, 0, 1}, 1), add(scene, make_mirror({.reflectance = gray(1)})));
    add(scene, make_disk({0, 0, 1}, {0, 0, 1}, 1), blended(scene, 0.4));
    check(scene, 0.6 * 0.6);
  }
}

TEST_CASE("a blended area light shines in proportion to its alpha, behind panes too") {
  for (const bool pane : {false, true}) {
    CAPTURE(pane);
    Scene scene = floor(4096);
    scene.camera.eye = {0.3, 0.5, 0.2};
    scene.render.max_depth = 1;
    add(scene, make_disk({0, 1, 0}, {0, 1, 0}, 1), blended(scene, 0.5, 1));
    if (pane)
      add(scene, make_disk({0, 0.9, 0}, {0, 1, 0}, 9), add(scene, make_dielectric({.ior = 1, .thin = true})));
    check(scene, 0.5 * shown(M_PI / 2), 1e-4);
  }
}
