// Media that scatter light, where the answer is known.
#include "patch.hpp"
#include "tests/support/medium_column.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The integral of f by Simpson's rule.
template <typename Function>
double integral(double from, double to, const Function& f) {
  constexpr int steps = 20000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i)
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * f(from + (to - from) * i / steps);
  return sum * (to - from) / (3 * steps);
}

}  // namespace

TEST_CASE("a medium everywhere absorbs light on its way to the eye and from a light") {
  Scene scene = patch({0.4, 0.9, 0.5}, {0, 0, 0}, 4);
  scene.medium.absorption = Vec3(0.3, 0, 0);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_phong({.diffuse = gray(0.8)})));
  add_point_light(scene, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  check(scene, 0.8 * 3 / 4 * std::exp(-0.3 * (2 + glm::length(scene.camera.eye))), 1e-5);
}

TEST_CASE("a light and a floor within an absorbing medium: the light is absorbed too") {
  Scene scene = patch({0.4, 0.9, 0.5}, {0, 0, 0}, 4);
  add(scene, make_sphere({0, 0, 0}, 10), add(scene, make_dielectric({.absorption = Vec3(0.3)})));
  add(scene, make_disk({0, 0, 0}, {0, 1, 0}, 5), add(scene, make_phong({.diffuse = gray(0.8)})));
  add_point_light(scene, {0, 2, 0}, Vec3(3), Falloff::inverse_square);
  check(scene, 0.8 * 3 / 4 * std::exp(-0.3 * (2 + glm::length(scene.camera.eye))), 1e-5);
}

TEST_CASE("a white medium in a furnace is invisible, whatever it scatters") {
  for (const double ior : {1.0, 1.5}) {
    for (const double g : {0.0, 0.8, -0.5}) {
      CAPTURE(ior);
      CAPTURE(g);
      Scene ball = patch({0, 0, 4}, {0.3, 0.4, 0}, 64);
      ball.render.background = Vec3(1);
      ball.render.max_depth = 1000;
      add(ball, make_sphere({0, 0, 0}, 1),
          add(ball, make_dielectric({.ior = ior, .scattering = Vec3(2), .anisotropy = g})));
      check(ball, 1, 2e-5);
    }
  }
}

TEST_CASE("a white medium within an area light keeps radiance 1: shadow rays and paths share the light") {
  for (const double g : {0.0, 0.9, -0.7}) {
    CAPTURE(g);
    Scene scene = patch({0.1, 0.2, 0.3}, {0.1, 0, -2}, 1024);
    scene.render.max_depth = 500;
    scene.medium.scattering = Vec3(0.4, 0.1, 0.8);
    scene.medium.anisotropy = g;
    add(scene, make_sphere({0, 0, 0}, 2), add(scene, make_phong({.diffuse = gray(0), .emission = gray(1)})));
    check(scene, 1, 1e-4);
  }
}

// ∫ σₛ p(cos θ) e^(−σ (t + d)) π I / d² dt along a ray that passes a point light at distance 1.
TEST_CASE("fog scatters a point's light once as its integral gives") {
  for (const double g : {0.0, 0.7, -0.4}) {
    CAPTURE(g);
    const double scattering = 0.2, absorption = 0.1, ahead = 3;
    Scene scene = patch({0, 0, ahead}, {0, 0, 0}, 4096);
    scene.medium = {
        .absorption = Vec3(absorption), .scattering = Vec3(scattering, 0.1, 0.4), .anisotropy = g};
    add_point_light(scene, {0, 1, 0}, Vec3(2), Falloff::inverse_square);
    const double expected = integral(0, 60, [&](double t) {
      const double along = ahead - t, d = std::sqrt(1 + along * along);
      // The ray goes along −z, and light comes straight from the point.
      const double phase = henyey_greenstein(g, along / d);
      return scattering * phase * std::exp(-(scattering + absorption) * (t + d)) * M_PI * 2 / (d * d);
    });
    check(scene, expected, 1e-4);
  }
}

// Chandrasekhar, Radiative Transfer, 1950: 1/H(μ) = √(1 − ϖ) + ½ϖ ∫ μ' H(μ') / (μ + μ') dμ'. If light comes
// evenly from everywhere, the half space returns 1 − H(μ) √(1 − ϖ).
TEST_CASE("a half space that scatters uniformly, lit from everywhere, has Chandrasekhar's reflectance") {
  const double mu = 0.6, root = std::sqrt(1 - albedo);
  constexpr int steps = 400;
  std::vector<double> h(steps, 1.0);
  const auto one_over = [&](double at) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += (i + 0.5) * h[size_t(i)] / (at + (i + 0.5) / steps);
    return root + 0.5 * albedo * sum / (double(steps) * steps);
  };
  for (int turn = 0; turn < 60; ++turn) {
    std::vector<double> next(steps);
    for (int i = 0; i < steps; ++i) next[size_t(i)] = 1 / one_over((i + 0.5) / steps);
    h = next;
  }
  Scene scene = patch({0, 2 * mu, 2 * std::sqrt(1 - mu * mu)}, {0, 0, 0}, 1024);
  scene.render.max_depth = 200;
  scene.render.background = Vec3(1);
  const Vec3 extinction(1, 2, 0.5);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}),
      add(scene,
          make_dielectric(
              {.ior = 1, .absorption = (1 - albedo) * extinction, .scattering = albedo * extinction})));
  check(scene, 1 - root / one_over(mu), 1e-4);
}
