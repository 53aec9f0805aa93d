// Queries of a scene's camera for tests.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine::test {

// The scene's camera as a PerspectiveCamera or another form; throws std::bad_variant_access if it has a
// different form.
template <typename Form>
Form camera_as(const Scene& scene) {
  return std::get<Form>(scene.camera.projection->form());
}

// The position of a world point in a perspective picture, from its middle to the right and up, in half
// widths.
inline Vec2 position_seen(const Scene& scene, const Vec3& point) {
  const CameraAxes camera = camera_axes(scene.camera);
  const double distance = scene.camera.projection->scale(scene.image.size()).z;
  const Vec3 way = point - camera.eye;
  return distance / glm::dot(way, camera.w) * Vec2(glm::dot(way, camera.u), glm::dot(way, camera.v));
}

}  // namespace eyeray::engine::test
