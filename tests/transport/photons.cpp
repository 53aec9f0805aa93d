// Photon mapping, compared with known answers and with `path`.
#include "host/scene/photons.hpp"
#include "by_photons.hpp"
#include "host/optics/fresnel.hpp"
#include "host/reference/photon_map.hpp"
#include "host/reference/renderer.hpp"
#include "tests/support/environments.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The light on a wall beside the floor.
enum class WallLight { sphere, ring, parallelogram, box, triangle, spot, environment, sun };

Scene beside_wall(WallLight light) {
  Scene scene = floor(1024);
  scene.render.max_depth = 1;
  const int white = add(scene, make_phong({.diffuse = gray(0.9)}));
  add(scene, make_parallelogram({0.8, 0, -1}, {0, 2, 0}, {0, 0, 2}), white);
  const int shining = emissive(scene, 4);
  switch (light) {
    case WallLight::sphere:
      add(scene, make_sphere({-0.5, 1.2, 0.1}, 0.25), shining);
      break;
    case WallLight::ring:
      add(scene, make_disk({-0.5, 1.2, 0.1}, {1, -1, 0}, 0.3, 0.1), shining);
      break;
    case WallLight::parallelogram:
      add(scene, make_parallelogram({-0.5, 1.2, 0}, {0.3, 0.3, 0}, {0, 0, 0.3}), shining);
      break;
    case WallLight::box:
      add(scene, make_box({-0.6, 1.1, 0}, {-0.3, 1.3, 0.4}), shining);
      break;
    case WallLight::triangle:
      add(scene, make_triangle({.vertices = {{{-0.5, 1, 0}, {-0.2, 1.3, 0}, {-0.4, 1.2, 0.5}}}}), shining);
      break;
    case WallLight::spot:
      add_spot(scene, {{-0.5, 1.2, 0.1}, {1, -0.4, 0}, Vec3(2), 0.3, 0.7});
      break;
    case WallLight::environment:
      scene.environment = environment(8, 4, [](const Vec3& d) { return Vec3(d.x < 0 ? 1.0 : 0.1); });
      break;
    case WallLight::sun:
      add_sun(scene, {-1, 0.6, 0}, Vec3(1), glm::radians(10.0));
  }
  return scene;
}

void check_wall(WallLight light, Backend backend, int photons, int samples, double greatest) {
  CAPTURE(int(light));
  check_as_paths([light] { return beside_wall(light); }, backend, photons, 0.08, samples, greatest);
}

// The flux of the photons that have hit `depth` surfaces before; of all photons if `depth` is below 0.
double brought(const reference::PhotonMap& map, int depth) {
  double sum = 0;
  for (const reference::Photon& photon : map.photons())
    if (depth < 0 || photon.depth == depth) sum += photon.flux.x;
  return sum / map.count();
}

}  // namespace

TEST_CASE("light scattered by one surface agrees with paths: no photon counts twice") {
  Scene scene = by_photons(floor(), 256, 0.1, 64, 0);
  add_point_light(scene, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  check_photons(scene, albedo * 3 / 4, 1e-4);
  // No other object could light the floor a second time.
  scene.render.max_depth = 4;
  check_photons(scene, albedo * 3 / 4, 1e-4);
}

TEST_CASE("the reference finds each photon near a point once, also where cells end") {
  constexpr double radius = 0.4;
  Scene ball = by_photons(patch({0, 0, 0}, {0, 0, -1}), 1 << 11, radius, 1, 4);
  add(ball, make_sphere({0, 0, 0}, 2), add(ball, make_phong({.diffuse = gray(0.5)})));
  add_point_light(ball, {0.3, 0.1, 0}, Vec3(1), Falloff::inverse_square);
  const reference::Renderer renderer(ball);
  const auto map = renderer.tracer().photons(0);
  for (const double far : {1, -1, 3, -3, 5, -5})
    for (int axis = 0; axis < 3; ++axis) {
      // A disk around this point ends at the borders of cells.
      Vec3 p(radius);
      p[axis] = far * radius;
      CAPTURE(far);
      CAPTURE(axis);
      std::vector<const reference::Photon*> found, near;
      map->near(p, [&](const reference::Photon& photon) {
        if (glm::length(photon.position - p) < radius) found.push_back(&photon);
      });
      for (const reference::Photon& photon : map->photons())
        if (glm::length(photon.position - p) < radius) near.push_back(&photon);
      std::ranges::sort(found);
      CHECK(found == near);
    }
}

TEST_CASE("a sun through a slab of glass has E = π I cos θ (1 − R)²") {
  for (const double degrees : {0.0, 40.0}) {
    CAPTURE(degrees);
    const double theta = glm::radians(degrees);
    Scene scene = by_photons(floor(), 1 << 13, 0.4, 32, 3);
    scene.camera.eye = {0.2, 0.3, 0.1};
    add(scene, make_box({-2, 0.4, -2}, {2, 0.6, 2}), add(scene, make_dielectric({.ior = 1.5})));
    add_sun(scene, {std::sin(theta), std::cos(theta), 0}, Vec3(0.5));
    // This depth leaves out photons that are reflected back and forth in the slab.
    scene.render.max_depth = 3;
    const double r = optics::dielectric_reflectance(std::cos(theta), 1, 1.5);
    check_photons(scene, albedo * 0.5 * std::cos(theta) * (1 - r) * (1 - r), 0.01, 1e-3);
  }
}

TEST_CASE("a point light in a white ball has L = (ρ/π)(E + ρ Ē / (1 − ρ))") {
  Scene ball = by_photons(patch({0, 0, 0}, {0, 0, -1}), 1 << 14, 0.18, 32, 200);
  add(ball, make_sphere({0, 0, 0}, 1), add(ball, make_phong({.diffuse = gray(0.5)})));
  add_point_light(ball, {0.3, 0.1, 0}, Vec3(1), Falloff::inverse_square);
  const Vec3 way = Vec3(0.3, 0.1, 0) - Vec3(0, 0, -1);
  const double direct = M_PI * glm::normalize(way).z / glm::dot(way, way);
  check_photons(ball, 0.5 / M_PI * (direct + 0.5 * M_PI / (1 - 0.5)), 0.02);
}

TEST_CASE("in an emitting ball L / (1 − ρ); if it is filled with an absorbing medium, L e^(−σR) / (1 − ρ T)" *
          doctest::test_suite("long")) {
  for (const double absorption : {0.0, 0.4}) {
    CAPTURE(absorption);
    Scene ball = by_photons(patch({0, 0, 0}, {0, 0, -1}), 1 << 16, 0.18, 32, 200);
    ball.medium.absorption = Vec3(absorption);
    add(ball, make_sphere({0, 0, 0}, 1), add(ball, make_phong({.diffuse = gray(0.5), .emission = gray(1)})));
    // T is the mean of e^(−σd) over the distances d from one point of the ball to the others.
    const double x = 2 * absorption;
    const double mean = x > 0 ? 2 * (1 - (1 + x) * std::exp(-x)) / (x * x) : 1;
    check_photons(ball, std::exp(-absorption) / (1 - 0.5 * mean));
  }
}

TEST_CASE("a wall lights a floor by photons as by paths; bias falls with the radius") {
  check_wall(WallLight::sun, Backend::twin, 1 << 14, 64, 0.02);
}

TEST_CASE("a wall lights a floor by photons as by paths, whatever the area light" *
          doctest::test_suite("long")) {
  for (const WallLight light : {WallLight::sphere, WallLight::ring, WallLight::parallelogram, WallLight::box,
                                WallLight::triangle, WallLight::spot, WallLight::environment, WallLight::sun})
    for (const Backend backend : {Backend::twin, Backend::reference})
      check_wall(light, backend, 1 << 13, 256, 0.1);  // an environment's shadow rays are the noisiest
}

TEST_CASE("photons carry all emitted flux: none is lost on the way, in glass and mirrors too") {
  const auto closed = [](bool with_glass) {
    Scene scene = by_photons(patch({0, 0, 0}, {0, 0, -1}), 1 << 14, 0.1, 1, 200);
    add(scene, make_sphere({0, 0, 0}, 2), add(scene, make_phong({.diffuse = gray(0.5)})));
    add_point_light(scene, {0.3, 0.1, 0}, Vec3(1), Falloff::inverse_square);
    if (with_glass) {
      add(scene, make_sphere({0, 1, 0}, 0.5), add(scene, make_dielectric({.ior = 1.5})));
      add(scene, make_sphere({0, -1, 0}, 0.4), add(scene, make_mirror({.reflectance = gray(1)})));
    }
    return scene;
  };
  // The emitted flux is 4π² I. All of it reaches the wall, which scatters half of it, and so on.
  const double sent = 4 * M_PI * M_PI;
  const Scene plain_scene = closed(false), glass_scene = closed(true);
  const reference::Renderer empty(plain_scene);
  const auto plain = empty.tracer().photons(0);
  for (const int depth : {1, 2, 3})
    CHECK(brought(*plain, depth) == doctest::Approx(sent * std::pow(0.5, depth)).epsilon(1e-9));
  CHECK(brought(*plain, -1) == doctest::Approx(sent).epsilon(0.003));

  // A photon that hits glass or a mirror on its way has been scattered before it first reaches the wall.
  const reference::Renderer with_glass(glass_scene);
  const auto seen = [](double squared, double radius) {
    return (1 - std::sqrt(1 - radius * radius / squared)) / 2;
  };
  const double scattered = seen(0.3 * 0.3 + 0.9 * 0.9, 0.5) + seen(0.3 * 0.3 + 1.1 * 1.1, 0.4);
  CHECK(brought(*with_glass.tracer().photons(0), -1) ==
        doctest::Approx(sent * (1 + scattered)).epsilon(0.006));
}

TEST_CASE("the radius is the first sample's, times the root of Π (i + 2/3) / (i + 1)") {
  const Scene scene = by_photons(floor(), 1024, 0.25, 1, 2);
  const PhotonSettings settings = photon_settings(scene);
  CHECK(settings.count == 1024);
  CHECK(photon_radius(settings, 0) == 0.25);
  CHECK(photon_radius(settings, 1) == doctest::Approx(0.25 * std::sqrt(5.0 / 6)));
  // Up to a factor, the radius decreases as n^(−1/6).
  const double ratio = photon_radius(settings, 4000) / photon_radius(settings, 500);
  CHECK(ratio == doctest::Approx(std::pow(8, -1.0 / 6)).epsilon(1e-3));
}
