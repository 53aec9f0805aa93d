// Where a point of the world lies in the picture of a scene.
#pragma once

#include "host/scene/camera_frame.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::test {

// In pixels from its top left corner.
inline Vec2 pixel(const Scene& scene, const Vec3& point) {
  const CameraFrame frame = camera_frame(scene.camera, scene.image.width, scene.image.height);
  const Vec3 p = point - scene.camera.eye;
  const double scale = frame.distance / glm::dot(p, frame.w);
  return {(1 + scale * glm::dot(p, frame.u)) / 2 * scene.image.width,
          (1 - scale * glm::dot(p, frame.v)) / 2 * scene.image.height};
}

}  // namespace eyeray::test
