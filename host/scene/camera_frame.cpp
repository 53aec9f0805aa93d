#include "host/scene/camera_frame.hpp"

#include <cmath>
#include <numbers>

namespace eyeray {

CameraFrame camera_frame(const Camera& camera, int width, int height) {
  CameraFrame frame;
  frame.w = glm::normalize(camera.target - camera.eye);
  frame.u = glm::normalize(glm::cross(frame.w, camera.up));
  frame.v = glm::cross(frame.u, frame.w);
  const double aspect = double(height) / width;
  if (camera.type == CameraType::orthographic) {
    frame.right = camera.size * frame.u;
    frame.up = camera.size * aspect * frame.v;
    frame.forward = frame.w;
    return frame;
  }

  // tan(α/2) scales like the length along which α is measured; bring it to the width.
  const double w = width;
  const double h = height;
  double measured = w;
  if (camera.fov_axis == FovAxis::vertical) measured = h;
  if (camera.fov_axis == FovAxis::shorter) measured = std::min(w, h);
  if (camera.fov_axis == FovAxis::diagonal) measured = std::hypot(w, h);
  const double half_width = std::tan(camera.fov_degrees * std::numbers::pi / 360) * w / measured;
  frame.distance = 1 / half_width;
  frame.horizontal_fov_degrees = std::atan(half_width) * 360 / std::numbers::pi;
  frame.vertical_fov_degrees = std::atan(half_width * aspect) * 360 / std::numbers::pi;
  frame.right = frame.u;
  frame.up = aspect * frame.v;
  frame.forward = frame.distance * frame.w;
  return frame;
}

}  // namespace eyeray
