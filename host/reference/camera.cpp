#include "host/reference/camera.hpp"

namespace eyeray::reference {

CameraRays::CameraRays(const Camera& camera, const ImageSettings& image)
    : axes_(camera_axes(camera)), projection_(camera.projection), size_(image.size()) {}

Ray CameraRays::ray(const Vec2& place) const {
  const double x = 2.0 * place.x / size_.x - 1.0;
  const double y = (1.0 - 2.0 * place.y / size_.y) * (size_.y / size_.x);
  return projection_->ray(axes_, {x, y}, size_);
}

}  // namespace eyeray::reference
