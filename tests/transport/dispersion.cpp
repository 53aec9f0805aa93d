// Glass that disperses light, by Snell's law and Fresnel's equations for the index of each colour channel.
#include <cmath>
#include <vector>

#include "patch.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The mean colour of the scene's samples.
Vec3 mean_color(const Scene& scene, Backend backend) {
  const auto executor = executors::make_executor(backend, scene, {});
  const Rect tile{0, 0, scene.image.width, scene.image.height};
  std::vector<PixelSample> samples(size_t(tile.pixels()));
  Vec3 sum(0);
  for (int i = 0; i < scene.image.samples; ++i) {
    executor->sample(tile, uint32_t(i), samples);
    for (const PixelSample& sample : samples) sum += Vec3(sample.color);
  }
  return sum / double(samples.size() * size_t(scene.image.samples));
}

// Fresnel's transmittance of unpolarised light, from air under that angle.
double transmitted(double angle, double ior) {
  const double inside = std::asin(std::sin(angle) / ior);
  const double s = std::sin(angle - inside) / std::sin(angle + inside);
  const double p = std::tan(angle - inside) / std::tan(angle + inside);
  return 1 - (s * s + p * p) / 2;
}

}  // namespace

TEST_CASE("dispersion: a light in glass is seen in one colour where only that colour is refracted to it") {
  constexpr double angle = M_PI / 3, abbe = 4, ior = 1.5;
  // n_F − n_C = (n_d − 1) / V: red is seen by the C line, green by the d line, blue by the F line.
  const double half = (ior - 1) / abbe / 2, indices[] = {ior - half, ior, ior + half};
  for (int seen = 0; seen < 3; ++seen) {
    CAPTURE(seen);
    const double at = std::tan(std::asin(std::sin(angle) / indices[seen]));
    Scene scene = patch({-3 * std::sin(angle), 3 * std::cos(angle), 0}, {0, 0, 0}, 64);
    scene.render.max_depth = 4;
    add(scene, make_box({-50, -50, -50}, {50, 0, 50}),
        add(scene, make_dielectric({.ior = ior, .dispersion = 20 / abbe})));
    add(scene, make_parallelogram({at - 0.01, -1, -1}, {0, 0, 2}, {0.02, 0, 0}), emissive(scene));
    for (const Backend backend : {Backend::twin, Backend::reference}) {
      CAPTURE(int(backend));
      const Vec3 color = mean_color(scene, backend);
      for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double expected = c == seen ? transmitted(angle, indices[c]) : 0;
        // A third of the samples carry three times the light, so each has a variance of 2 at most.
        CHECK(std::abs(color[c] - expected) <= (expected > 0 ? 5 * std::sqrt(2.0 / (64 * 64)) : 0));
      }
    }
  }
}

TEST_CASE("dispersion changes no light of one index: a slab's sides cancel, and a furnace stays white") {
  Scene scene = patch({0, 3, 0.5}, {0, 0, 0}, 256);
  scene.render.max_depth = 40;
  scene.render.background = Vec3(1);
  add(scene, make_sphere({0, 0, 0}, 1),
      add(scene, make_principled(
                     {.color = gray(1), .roughness = gray(0), .transmission = gray(1), .dispersion = 3})));
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    CAPTURE(int(backend));
    const Vec3 color = mean_color(scene, backend);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(color[c] - 1) < 5 * std::sqrt(2.0 / (64 * 256)));
  }
}
