#include "host/scene/photons.hpp"

#include <algorithm>
#include <cmath>

#include "host/scene/extent.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine {
namespace {

constexpr double pixels_across = 2;

// The spacing of the rays of neighbouring pixels in the middle of the picture, at this distance from the
// camera.
double pixel_at(const Scene& scene, double distance) {
  const CameraAxes axes = camera_axes(scene.camera);
  const Vec2 size = scene.image.size();
  const auto at = [&](const Vec2& position) {
    const Ray ray = scene.camera.projection->ray(axes, position, Vec2(0.0), size);
    return ray.o + distance * ray.d;
  };
  return glm::length(at({2 / size.x, 0}) - at({0, 0}));
}

// Sets the sphere around the box. It is a little larger, so that rounding makes it no smaller than the box.
void put_around(const Bounds& box, PhotonSettings& settings) {
  settings.center = (box.min + box.max) / 2.0;
  settings.reach = glm::length(box.max - box.min) / 2 * (1 + 1e-5);
}

}  // namespace

PhotonSettings photon_settings(const Scene& scene) {
  Bounds all = extent(scene);
  const bool endless = !(all.min.x <= all.max.x);
  if (endless) all.include(scene.camera.eye);
  PhotonSettings settings{.count = uint32_t(scene.render.photons),
                          .radius = scene.render.photon_radius,
                          .center = {},
                          .reach = 0};
  put_around(all, settings);
  if (settings.radius == 0) {
    const Vec3 middle = endless ? scene.camera.target : settings.center;
    const double distance = glm::length(middle - scene.camera.eye);
    settings.radius = pixels_across * pixel_at(scene, std::max(distance, settings.reach / 4));
  }
  settings.targets = photon_targets(scene, settings.reach);
  // Light from infinitely far away also passes through a bounded medium, so its photons start in front of the
  // medium.
  const Bounds medium = scene.medium_extent.bounds();
  if (std::isfinite(glm::length(medium.max - medium.min))) {
    all.include(medium.min);
    all.include(medium.max);
    put_around(all, settings);
  }
  return settings;
}

double photon_radius(const PhotonSettings& settings, uint32_t index) {
  constexpr double kept = 2.0 / 3;
  double squared = settings.radius * settings.radius;
  for (uint32_t i = 1; i <= index; ++i) squared *= (i + kept) / (i + 1);
  return std::sqrt(squared);
}

}  // namespace eyeray::engine
