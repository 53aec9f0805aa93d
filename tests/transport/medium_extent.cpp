// [medium] with an extent, in the light of a sun, a sky and the surroundings, compared with numerical
// integrals.
#include "patch.hpp"
#include "tests/support/environments.hpp"
#include "tests/support/medium_column.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

struct Case {
  std::string name;
  MediumExtent extent;
};

// A box, everything below a height, height fog, and height fog in a box.
std::vector<Case> extents() {
  std::vector<Case> all(4);
  all[0] = {"box", {.min = {-3, -1, -2}, .max = {2, 2.5, 4}}};
  all[1].name = "top";
  all[1].extent.max.y = 2;
  all[2].name = "fog";
  all[2].extent.scale_height = 1.5;
  all[2].extent.base = 0.25;
  all[3] = {"fog in a box", {.min = {-3, -1, -2}, .max = {2, 2.5, 4}, .scale_height = 0.7}};
  return all;
}

// The length of the ray in the medium, up to a point beyond which next to no medium is left.
double to_infinity(const MediumExtent& extent, const Vec3& o, const Vec3& d) {
  return length_in(extent, {o, d}, 40, 400);
}

}  // namespace

TEST_CASE("an absorbing medium weakens a sun's light on its way to a floor and to the eye") {
  const double absorption = 0.3;
  const Vec3 to_sun = glm::normalize(Vec3(0.4, 1, -0.3));
  for (const Case& each : extents())
    for (const double angle : {0.0, 0.01}) {
      CAPTURE(each.name);
      CAPTURE(angle);
      Scene scene = floor(16);
      scene.medium.absorption = Vec3(absorption);
      scene.medium_extent = each.extent;
      add_sun(scene, to_sun, Vec3(2), angle);
      const double length = glm::length(scene.camera.eye);
      const double depth = to_infinity(each.extent, {0, 0, 0}, to_sun) +
                           length_in(each.extent, {{0, 0, 0}, scene.camera.eye / length}, length, 400);
      check(scene, albedo * 2 * to_sun.y * std::exp(-absorption * depth), 1e-5);
    }
}

// ∫ σₛ ρ(t) p(cos θ) e^(−σₜ (L(t) + L to the sun)) π I dt.
TEST_CASE("a medium with an extent scatters a sun's light once as its integral gives") {
  const double scattering = 0.3, absorption = 0.1, sun = 2;
  const Vec3 to_sun = glm::normalize(Vec3(-0.5, 1, 0.4));
  const Vec3 eye(-6, 0.5, 1), d = glm::normalize(Vec3(6, 0.8, -0.4));
  for (const Case& each : extents())
    for (const double g : {0.0, 0.6}) {
      CAPTURE(each.name);
      CAPTURE(g);
      Scene scene = patch(eye, eye + d, 2048);
      scene.medium = {
          .absorption = Vec3(absorption), .scattering = Vec3(scattering, 0.2, 0.4), .anisotropy = g};
      scene.medium_extent = each.extent;
      add_sun(scene, to_sun, Vec3(sun));
      const double phase = henyey_greenstein(g, glm::dot(d, to_sun));
      const double expected = along(each.extent, {eye, d}, 80, 600, [&](double t, double density) {
        const double length =
            length_in(each.extent, {eye, d}, t, 400) + to_infinity(each.extent, eye + t * d, to_sun);
        return scattering * density * phase * std::exp(-(scattering + absorption) * length) * M_PI * sun;
      });
      check(scene, expected, 1e-4);
    }
}

TEST_CASE("a white medium with an extent is invisible in a furnace") {
  for (const Case& each : extents())
    for (const bool environment_light : {false, true}) {
      CAPTURE(each.name);
      CAPTURE(environment_light);
      Scene scene = patch({0.4, 0.9, 0.5}, {0, 0, 0}, environment_light ? 1024 : 256);
      scene.render.max_depth = 1000;
      if (environment_light)
        scene.environment = environment(8, 4, [](const Vec3&) { return Vec3(1); });
      else
        scene.render.background = Vec3(1);
      scene.medium = {.scattering = Vec3(0.5, 0.2, 0.9), .anisotropy = 0.3};
      scene.medium_extent = each.extent;
      add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_phong({.diffuse = gray(1)})));
      check(scene, 1, 1e-4);
    }
}

TEST_CASE("[medium] absorbs a sun's light between interfaces too, but not within another medium") {
  const double absorption = 0.3;
  Scene scene = floor(16);
  scene.medium.absorption = Vec3(absorption);
  scene.medium_extent.max.y = 4;
  add(scene, make_box({-50, 1, -50}, {50, 2, 50}), add(scene, make_dielectric({.ior = 1})));
  add_sun(scene, {0, 1, 1}, Vec3(2));
  const double depth = 3 * std::sqrt(2.0) + glm::length(scene.camera.eye);
  check(scene, albedo * 2 * std::sqrt(0.5) * std::exp(-absorption * depth), 1e-4);
}

// A mirror turns a vertical sun's light towards a wall: only photons find that light.
TEST_CASE("a sun's photons are absorbed before their start, on their way, and to the eye") {
  const double absorption = 0.2;
  for (const bool box : {false, true}) {
    CAPTURE(box);
    Scene scene = patch({1, 1.2, 0.2}, {0, 1, 0}, 64 * amount(8, 1, 1));  // as many photons in every run
    scene.image.width = scene.image.height = 2;
    scene.render.integrator = IntegratorType::sppm;
    scene.render.photons = 20000;
    scene.render.photon_radius = 0.1;
    scene.render.max_depth = 1;
    scene.medium.absorption = Vec3(absorption);
    if (box)
      scene.medium_extent = {.min = {-1, -3, -5}, .max = {5, 8, 5}};
    else
      scene.medium_extent.max.y = 8;
    add(scene, make_parallelogram({0, 0, -1}, {0, 2, 0}, {0, 0, 2}),
        add(scene, make_phong({.diffuse = gray(albedo)})));
    add(scene, make_parallelogram({1, 0, -1}, {2, 2, 0}, {0, 0, 2}),
        add(scene, make_mirror({.reflectance = gray(1)})));
    add_sun(scene, {0, 1, 0}, Vec3(3));
    const double length = 7 + 2 + glm::length(scene.camera.eye - Vec3(0, 1, 0));
    for (const Backend backend : {Backend::twin, Backend::reference}) {
      const Estimate found = estimate(scene, backend);
      CAPTURE(int(backend));
      CAPTURE(found.mean);
      CHECK(found.mean == doctest::Approx(albedo * 3 * std::exp(-absorption * length)).epsilon(0.02));
    }
  }
}
