#include "host/scene/camera.hpp"

namespace eyeray::engine {

CameraAxes camera_axes(const Camera& camera) {
  CameraAxes axes{.eye = camera.eye, .u = {}, .v = {}, .w = glm::normalize(camera.target - camera.eye)};
  axes.u = glm::normalize(glm::cross(axes.w, camera.up));
  axes.v = glm::cross(axes.u, axes.w);
  return axes;
}

CameraFrame camera_frame(const Camera& camera, const Vec2& size) {
  const CameraAxes axes = camera_axes(camera);
  const Vec3 scale = camera.projection->scale(size);
  return {scale.x * axes.u, scale.y * axes.v, scale.z * axes.w};
}

}  // namespace eyeray::engine
