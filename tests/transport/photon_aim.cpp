// Tests the targets of photons, and that aiming changes only the noise.
#include "host/reference/photon_source.hpp"
#include "host/reference/renderer.hpp"
#include "host/reference/rng.hpp"
#include "patch.hpp"
#include "tests/support/environments.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

enum class Aiming { point, spot, wide_spot, sun, environment, ball, plate };
constexpr Aiming all_lights[] = {Aiming::point,       Aiming::spot, Aiming::wide_spot, Aiming::sun,
                                 Aiming::environment, Aiming::ball, Aiming::plate};

const std::array<PhotonTarget, 3> balls = {
    {{{0, 0, 0}, 0.2}, {{0.25, 0, 0.1}, 0.15}, {{-0.5, -0.9, 0}, 0.1}}};

// Two balls that overlap and one beside them, of glass or not; most of the light goes past them.
Scene above_balls(Aiming aiming, bool glass, std::span<const PhotonTarget> those = balls) {
  Scene scene = floor();
  scene.render.integrator = IntegratorType::sppm;
  scene.render.photons = 1;
  const int material = add(scene, glass ? make_dielectric({.ior = 1.5}) : make_phong({.diffuse = gray(0.5)}));
  for (const PhotonTarget& ball : those) add(scene, make_sphere(ball.center, ball.radius), material);
  add(scene, make_sphere({0, 4, 0}, 0.5), add(scene, make_phong({.diffuse = gray(0.5)})));
  switch (aiming) {
    case Aiming::point:
      add_point_light(scene, {0.1, 2, 0.2}, Vec3(1), Falloff::inverse_square);
      break;
    case Aiming::spot:  // its rim goes through a ball
      add_spot(scene, {{0.1, 2, 0.2}, glm::normalize(Vec3(0.2, -2, -0.1)), Vec3(1), 0.05, 0.12});
      break;
    case Aiming::wide_spot:
      add_spot(scene, {{0.1, 2, 0.2}, glm::normalize(Vec3(-1, -1, 0)), Vec3(1), 0.5, 1.2});
      break;
    case Aiming::sun:
      add_sun(scene, {-1, 2, 0.5}, Vec3(1), glm::radians(20.0));
      break;
    case Aiming::environment:
      scene.environment = environment(8, 4, [](const Vec3& d) { return Vec3(d.y > 0 ? 1.0 : 0.2); });
      break;
    case Aiming::ball:
      add(scene, make_sphere({0.1, 2, 0.2}, 0.3), emissive(scene));
      break;
    case Aiming::plate:  // both sides of it, and the balls above and below its plane
      add(scene, make_parallelogram({0.6, -0.2, -0.2}, {0, 0.5, 0.1}, {0.1, 0, 0.4}), emissive(scene));
  }
  return scene;
}

struct Flux {
  Estimate all, at_balls;  // the emitted flux, and its part that goes towards a ball
  double share;            // share of the photons that go towards a ball
};

bool heads_for(const Ray& ray, const PhotonTarget& ball) {
  const Vec3 way = ball.center - ray.o;
  const double along = glm::dot(way, ray.d);
  return along > 0 && glm::length(way - along * ray.d) < ball.radius;
}

Flux flux_of(const Scene& scene, std::span<const PhotonTarget> those = balls) {
  const reference::Renderer renderer(scene);
  const reference::PhotonSources sources(renderer.tracer());
  const int count = 1 << 18;
  double sums[2] = {0, 0}, squares[2] = {0, 0};
  int heading = 0;
  for (int i = 0; i < count; ++i) {
    const auto pair = [&](uint32_t use) { return reference::random_pair(7, uint32_t(i), use, 1); };
    const reference::PhotonSource source = sources.draw(pair);
    const bool at_balls =
        std::ranges::any_of(those, [&](const auto& ball) { return heads_for(source.ray, ball); });
    heading += at_balls;
    for (const int of : {0, 1}) {
      const double value = of == 0 || at_balls ? source.flux.x : 0;
      sums[of] += value;
      squares[of] += value * value;
    }
  }
  const auto estimate_of = [&](int of) {
    const double mean = sums[of] / count;
    return Estimate{mean, std::sqrt(std::max(0.0, squares[of] / count - mean * mean) / count)};
  };
  return {estimate_of(0), estimate_of(1), double(heading) / count};
}

std::vector<PhotonTarget> targets_of(const Scene& scene) {
  return photon_settings(scene).targets;
}

bool holds(const PhotonTarget& outer, const PhotonTarget& inner) {
  return glm::length(outer.center - inner.center) + inner.radius <= outer.radius;
}

}  // namespace

TEST_CASE("aimed photons carry the same flux as others, to glass and past it, with less noise there") {
  for (const Aiming aiming : all_lights) {
    CAPTURE(int(aiming));
    // The photons' random numbers are independent, so that standard errors are known.
    const Flux at_random = flux_of(above_balls(aiming, false)), by_aim = flux_of(above_balls(aiming, true));
    for (const auto of : {&Flux::all, &Flux::at_balls}) {
      const Estimate &a = at_random.*of, &b = by_aim.*of;
      CAPTURE(a.mean);
      CAPTURE(b.mean);
      CHECK(b.error < 0.005 * b.mean);
      CHECK(std::abs(a.mean - b.mean) < 5 * std::hypot(a.error, b.error) + 1e-9 * a.mean);
    }
    // Without aiming, a narrow spot shines at the balls already.
    if (aiming != Aiming::spot) CHECK(by_aim.at_balls.error < 0.7 * at_random.at_balls.error);
    // No ball is visible from some points of an area light.
    CHECK(by_aim.share > 0.25);
  }
}

TEST_CASE("photons towards a ball carry a point light's share by solid angle, and a sun's by disk") {
  const std::span one(balls.data(), 1);
  const auto check_at_ball = [&](Aiming aiming, double expected) {
    CAPTURE(int(aiming));
    const Estimate found = flux_of(above_balls(aiming, true, one), one).at_balls;
    CHECK(found.error < 0.003 * expected);
    CHECK(std::abs(found.mean - expected) < 5 * found.error);
  };
  const double sine = balls[0].radius / glm::length(Vec3(0.1, 2, 0.2) - balls[0].center);
  check_at_ball(Aiming::point, 4 * M_PI * M_PI * (1 - std::sqrt(1 - sine * sine)) / 2);
  check_at_ball(Aiming::sun,
                M_PI * balls[0].radius * balls[0].radius * 2 * M_PI / (1 + std::cos(glm::radians(10.0))));
}

TEST_CASE("targets are spheres around glass, mirrors, smooth metal and panes, in instances too") {
  Scene scene = floor();
  const int glass = add(scene, make_dielectric({.ior = 1.5}));
  add(scene, make_sphere({3, 0, 0}, 0.5), add(scene, make_phong({.diffuse = gray(0.5)})));
  add(scene, make_sphere({-3, 0, 0}, 0.5), emissive(scene));
  CHECK(targets_of(scene).empty());

  add(scene, make_sphere({0, 1, 0}, 0.5), glass);
  REQUIRE(targets_of(scene).size() == 1);
  CHECK(targets_of(scene)[0].center == Vec3(0, 1, 0));
  CHECK(targets_of(scene)[0].radius == doctest::Approx(0.5).epsilon(2e-3));
  CHECK(targets_of(scene)[0].radius > 0.5);

  add(scene, make_box({1, 0, 0}, {1.2, 0.4, 0.4}), add(scene, make_mirror({.reflectance = gray(1)})));
  REQUIRE(targets_of(scene).size() == 2);
  CHECK(targets_of(scene)[1].radius == doctest::Approx(0.3).epsilon(2e-3));

  // A target as wide as the scene, or unbounded, is hit without aiming.
  add(scene, make_sphere({0, 0, 0}, 20), glass);
  add(scene, make_plane({0, 3, 0}, {0, 1, 0}), glass);
  CHECK(targets_of(scene).size() == 2);
}

TEST_CASE("neighbouring targets share a sphere if there are many, and each is in one") {
  Scene scene = floor();
  const int glass = add(scene, make_dielectric({.ior = 1.5}));
  std::vector<PhotonTarget> all;
  for (int i = 0; i < 100; ++i) {
    const Vec3 center(std::fmod(i * 0.618, 1) * 10, std::fmod(i * 0.7548, 1) * 10, i * 0.1);
    all.push_back({center, 0.1});
    add(scene, make_sphere(center, 0.1), glass);
  }
  const std::vector<PhotonTarget> targets = targets_of(scene);
  CHECK(targets.size() == most_photon_targets);
  for (const PhotonTarget& each : all)
    CHECK(std::ranges::any_of(targets, [&](const PhotonTarget& target) { return holds(target, each); }));
  for (const PhotonTarget& target : targets) CHECK(target.radius < 5);
}
