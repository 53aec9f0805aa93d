// Pictures of one small patch, so that their pixels are 64 estimates of one value, independent of each other.
#pragma once

#include <cmath>
#include <vector>

#include "host/scene/integrator.hpp"
#include "host/scene/sampler.hpp"
#include "tests/support/estimate.hpp"

#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

using namespace shapes;
using namespace materials;
using executors::Backend;

inline constexpr double albedo = 0.8;

// A scene seen from `eye`, so narrowly that the picture shows one point of it.
inline Scene patch(const Vec3& eye, const Vec3& target, int samples = 256) {
  Scene scene = one_pixel(eye, target);
  scene.image = {.width = 8, .height = 8, .samples = samples, .pattern = SamplePattern::sobol};
  scene.camera.projection = cameras::make_projection(PerspectiveCamera{.fov_degrees = 1e-3});
  scene.render.integrator = IntegratorType::path;
  scene.render.max_depth = 0;
  return scene;
}

// A white floor at y = 0, seen around the origin.
inline Scene floor(int samples = 256) {
  Scene scene = patch({0.4, 0.9, 0.5}, {0, 0, 0}, samples);
  add(scene, make_plane({0, 0, 0}, {0, 1, 0}), add(scene, make_phong({.diffuse = gray(albedo)})));
  return scene;
}

inline int emissive(Scene& scene, double radiance = 1) {
  return add(scene, make_phong({.diffuse = gray(0), .emission = gray(radiance)}));
}

// The radiance of a floor under an irradiance.
inline double shown(double irradiance) {
  return albedo * irradiance / M_PI;
}

inline void check(const Scene& scene, double expected, double least_error = 2e-6) {
  CAPTURE(expected);
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    const Estimate found = estimate(scene, backend);
    CAPTURE(int(backend));
    CAPTURE(found.mean);
    CAPTURE(found.error);
    if (expected == 0) {
      CHECK(found.mean == 0);
      continue;
    }
    CHECK(found.error < greatest_error() * expected);
    // At five standard errors, one in a million and a half such tests fails by chance.
    CHECK(std::abs(found.mean - expected) < 5 * found.error + least_error * expected);
  }
}

// Irradiance at the floor's origin from a polygon above it of radiance 1 (Lambert 1760).
inline double irradiance_of(const std::vector<Vec3>& corners) {
  double sum = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
    sum += std::acos(std::min(1.0, glm::dot(a, b))) * glm::normalize(glm::cross(a, b)).y;
  }
  return std::abs(sum) / 2;
}

}  // namespace eyeray::engine::test
