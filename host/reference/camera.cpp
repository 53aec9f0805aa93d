#include "host/reference/camera.hpp"

#include <cmath>

#include "host/reference/emitter_sample.hpp"

namespace eyeray::engine::reference {
namespace {

// A uniform point on the polygon with its corners on the circle of radius 1. u.x: the position along its
// border; u.y: how far out.
Vec2 on_polygon(const Vec2& u, int corners, double rotation) {
  const double side = std::floor(u.x * corners);
  const auto corner = [&](double i) {
    const double angle = rotation + 2 * M_PI * i / corners;
    return Vec2(std::cos(angle), std::sin(angle));
  };
  return std::sqrt(u.y) * glm::mix(corner(side), corner(side + 1), u.x * corners - side);
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, const ImageSettings& image)
    : axes_(camera_axes(camera)),
      projection_(camera.projection),
      aperture_(camera.projection->aperture()),
      size_(image.size()) {}

Vec2 CameraRays::lens_point(const Vec2& u) const {
  const Aperture& lens = aperture_;
  return lens.radius * (lens.blades == 0 ? on_disk(u) : on_polygon(u, lens.blades, lens.blade_rotation));
}

Vec2 CameraRays::from_middle(const Vec2& position) const {
  return {2.0 * position.x / size_.x - 1.0, (1.0 - 2.0 * position.y / size_.y) * (size_.y / size_.x)};
}

Ray CameraRays::ray(const Vec2& position, const Vec2& lens) const {
  return projection_->ray(axes_, from_middle(position), lens, size_);
}

bool CameraRays::sees(const Vec2& position, const Vec2& lens) const {
  return projection_->sees(from_middle(position), lens, size_);
}

}  // namespace eyeray::engine::reference
