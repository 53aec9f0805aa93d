// The numbers that follow from a camera and a picture's size (docs/conventions.md).
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray {

// Perspective rays go along right·X + up·Y + forward; orthographic ones start at eye + right·X + up·Y and go
// along forward. X, Y in [−1, 1] span the picture, Y up.
struct CameraFrame {
  Vec3 u, v, w;  // unit: image right, image up, the way the camera looks
  Vec3 right, up, forward;
  double distance = 0;                // perspective: D, of an image plane whose X reaches from −1 to 1
  double horizontal_fov_degrees = 0;  // perspective
  double vertical_fov_degrees = 0;    // perspective
};

CameraFrame camera_frame(const Camera& camera, int width, int height);

}  // namespace eyeray
