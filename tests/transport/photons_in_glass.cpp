// Photons in glass. Flux is radiance times area times solid angle. Behind a surface that refracts, solid
// angles shrink by the square of the index. Paths carry radiance / index², so the light of photons there has
// to be divided by index².
#include "by_photons.hpp"
#include "tests/support/environments.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr Rect picture{0, 0, 8, 8};

// The object between two disks.
enum class Between {
  glass,
  nested,
  hollow,
  principled,
  interface,
  principled_air,
  frosted,
  rough,
  opal,
  frosted_pane
};

constexpr double upper = 0, lower = -1.4;  // heights of the disks: one inside the object, one outside

// In thermal equilibrium everything has the radiance 1 / index² = 1, however surfaces mirror, refract or
// scatter it: each surface emits as much as it absorbs (Kirchhoff).
Scene equilibrium(Between between, const Vec3& eye, const Vec3& target) {
  Scene scene = patch(eye, target);
  scene.environment = environment(8, 4, [](const Vec3&) { return Vec3(1); });
  const int warm = add(scene, make_phong({.diffuse = gray(0.5), .emission = gray(0.5)}));
  for (const double y : {upper, lower}) add(scene, make_disk({0, y, 0}, {0, 1, 0}, 0.8), warm);
  const auto box = [&](double half, std::unique_ptr<Material> material) {
    add(scene, make_box({-half, -half, -half}, {half, half, half}), add(scene, std::move(material)));
  };
  const auto rough = [](double roughness, double transmission = 1, bool thin = false) {
    return make_principled(
        {.color = gray(1), .roughness = gray(roughness), .transmission = gray(transmission), .thin = thin});
  };
  switch (between) {
    case Between::glass:
      box(1, make_dielectric({.ior = 1.5}));
      break;
    case Between::nested:
      box(1.1, make_dielectric({.ior = 1.33}));
      box(1, make_dielectric({.ior = 1.8}));
      break;
    case Between::hollow:
      box(1, make_dielectric({.ior = 1.5}));
      box(0.9, make_dielectric({.ior = 1}));
      break;
    case Between::principled:
      box(1, rough(0));
      break;
    case Between::interface:
      box(1, make_dielectric({.ior = 1}));
      break;
    case Between::principled_air:
      box(1, make_principled({.color = gray(1), .ior = 1, .transmission = gray(0.6)}));
      break;
    case Between::frosted:
      box(1, make_dielectric({.ior = 1.5, .roughness = gray(0.7)}));
      break;
    case Between::rough:
      box(1, rough(1));
      break;
    case Between::opal:
      box(1, rough(0.7, 0.6));
      break;
    case Between::frosted_pane:
      box(1, rough(0.7, 1, true));
      break;
  }
  return scene;
}

void check_equilibrium(std::initializer_list<Between> all, int photons, double greatest) {
  struct View {
    Vec3 eye, target;
  };
  // Views from inside onto the disk there, and from outside onto the object's surface and onto the other
  // disk.
  const View views[] = {
      {{0.1, 0.5, 0.1}, {0, upper, 0}}, {{0.1, 2, 0.1}, {0, 1, 0}}, {{0.1, lower + 0.2, 0.1}, {0, lower, 0}}};
  for (const Between between : all) {
    for (const View& view : views) {
      CAPTURE(int(between));
      CAPTURE(view.target.y);
      const Scene scene = by_photons(equilibrium(between, view.eye, view.target), photons, 0.5, 32, 200);
      check_photons(scene, 1, greatest, 0.002, {0, 0, 4, 4});
    }
  }
}

// A matte disk in a ball of glass, with an area light above it.
Scene disk_in_ball() {
  Scene scene = patch({2, 3, 0}, {0, -0.2, 0}, 2048);
  scene.render.max_depth = 16;
  add(scene, make_sphere({0, 0, 0}, 1), add(scene, make_dielectric({.ior = 1.5})));
  add(scene, make_disk({0, -0.2, 0}, {0, 1, 0}, 0.8), add(scene, make_phong({.diffuse = gray(albedo)})));
  add(scene, make_sphere({0, 6, 0}, 1.5), emissive(scene, 10));
  return scene;
}

// Glass that shines, around a matte disk and above another: light starts on both sides of its surface.
Scene shining_box(double disk) {
  Scene scene = patch({0.1, disk + 0.3, 0.1}, {0, disk, 0}, 1024);
  scene.render.max_depth = 16;
  add(scene, make_box({-1, -1, -1}, {1, 1, 1}),
      add(scene,
          make_principled(
              {.color = gray(1), .roughness = gray(0), .transmission = gray(1), .emission = gray(1)})));
  const int matte = add(scene, make_phong({.diffuse = gray(albedo)}));
  for (const double y : {upper, lower}) add(scene, make_disk({0, y, 0}, {0, 1, 0}, 0.8), matte);
  return scene;
}

// An area light above a slab of frosted glass.
Scene frosted_slab(const Vec3& eye, const Vec3& target) {
  Scene scene = patch(eye, target, 2048);
  scene.render.max_depth = 12;
  add(scene, make_box({-1.5, 0, -1.5}, {1.5, 0.3, 1.5}),
      add(scene, make_dielectric({.ior = 1.5, .roughness = gray(0.6)})));
  add(scene, make_disk({0.3, 1.3, 0}, {0, -1, 0}, 0.6), emissive(scene, 10));
  return scene;
}

// A ball of frosted glass below an area light; the camera below the ball looks towards the floor that the
// ball lights.
Scene below_frosted_ball() {
  Scene scene = patch({-0.5, 0.15, 0.6}, {0, 0, 0}, 1024);
  scene.render.max_depth = 12;
  add(scene, make_disk({0, 0, 0}, {0, 1, 0}, 2), add(scene, make_phong({.diffuse = gray(albedo)})));
  add(scene, make_sphere({0, 0.7, 0}, 0.5),
      add(scene, make_dielectric({.ior = 1.5, .roughness = gray(0.6)})));
  add(scene, make_disk({0.4, 2, 0}, {0, -1, 0}, 0.8), emissive(scene, 10));
  return scene;
}

}  // namespace

TEST_CASE("in thermal equilibrium photons show 1 on both sides of glass") {
  check_equilibrium({Between::glass, Between::rough}, 1 << 12, 0.1);
}

TEST_CASE("in thermal equilibrium photons show 1 in any glass: nested, hollow, rough and thin" *
          doctest::test_suite("long")) {
  check_equilibrium(
      {Between::glass, Between::nested, Between::hollow, Between::principled, Between::interface,
       Between::principled_air, Between::frosted, Between::rough, Between::opal, Between::frosted_pane},
      1 << 14, 0.15);
}

TEST_CASE("a disk in a ball of glass is as bright by photons as by paths") {
  for (const Backend backend : {Backend::twin, Backend::reference})
    check_as_paths(disk_in_ball, backend, 1 << 13, 0.2, 32, 0.06, 0.03, picture);
}

TEST_CASE("emitting glass lights objects in it and around it by photons as by paths") {
  for (const Backend backend : {Backend::twin, Backend::reference})
    for (const double disk : {upper, lower}) {
      CAPTURE(disk);
      check_as_paths([disk] { return shining_box(disk); }, backend, 1 << 12, 0.25, 32, 0.06, 0.03, picture);
    }
}

TEST_CASE("frosted glass reflects and transmits by photons as by paths" * doctest::test_suite("long")) {
  const auto below = [] { return frosted_slab({0.5, -1, 0.3}, {0, 0, 0}); };
  const auto above = [] { return frosted_slab({-1.2, 1.2, 0.3}, {0, 0.3, 0}); };
  check_as_paths(below, Backend::twin, 1 << 16, 0.25, 64, 0.06, 0.03, {0, 0, 2, 2});
  check_as_paths(above, Backend::twin, 1 << 16, 0.25, 64, 0.06, 0.03, {0, 0, 2, 2});
}

TEST_CASE("light through a frosted ball lights a floor by photons as by paths" *
          doctest::test_suite("long")) {
  check_as_paths(below_frosted_ball, Backend::twin, 1 << 16, 0.05, 64, 0.05, 0.03, picture);
}
