#include "host/reference/camera.hpp"

#include <cmath>
#include <numbers>

#include "host/reference/rng.hpp"

namespace eyeray::reference {

// tan(α/2) for the horizontal field of view α.
static double horizontal_tangent(const Camera& camera, double width, double height) {
  const double tangent = std::tan(camera.fov_degrees * std::numbers::pi / 360.0);
  switch (camera.fov_axis) {
    case FovAxis::horizontal:
      return tangent;
    case FovAxis::vertical:
      return tangent * width / height;
    case FovAxis::shorter:
      return width <= height ? tangent : tangent * width / height;
    case FovAxis::diagonal:
      return tangent * width / std::sqrt(width * width + height * height);
  }
  return tangent;
}

CameraRays::CameraRays(const Camera& camera, const ImageSettings& image)
    : type_(camera.type),
      eye_(camera.eye),
      w_(glm::normalize(camera.target - camera.eye)),
      distance_(1.0 / horizontal_tangent(camera, image.width, image.height)),
      size_(camera.size),
      width_(image.width),
      height_(image.height) {
  u_ = glm::normalize(glm::cross(w_, camera.up));
  v_ = glm::cross(u_, w_);
}

Ray CameraRays::ray(const Vec2& place) const {
  const double x = 2.0 * place.x / width_ - 1.0;
  const double y = (1.0 - 2.0 * place.y / height_) * (height_ / width_);
  const Vec3 across = x * u_ + y * v_;
  switch (type_) {
    case CameraType::perspective:
      return {eye_, glm::normalize(across + distance_ * w_)};
    case CameraType::orthographic:
      return {eye_ + size_ * across, w_};
  }
  return {eye_, w_};
}

Vec2 sample_position(const ImageSettings& image, uint32_t seed, int x, int y, uint32_t index) {
  // Take the sample's cell of the n × n that the pixel is cut into, and a place in it.
  const auto n = uint32_t(std::lround(std::sqrt(image.samples)));
  const Vec2 cell(index % n, index / n);
  Vec2 place(0.5);
  if (image.pattern == SamplePattern::jittered) {
    const uint32_t pixel = uint32_t(y) * uint32_t(image.width) + uint32_t(x);
    place = {random(pixel, index, 0, seed), random(pixel, index, 1, seed)};
  }
  return (cell + place) / double(n);
}

}  // namespace eyeray::reference
