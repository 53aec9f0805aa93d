#include "host/reference/camera.hpp"

#include <cmath>

#include "host/reference/rng.hpp"

namespace eyeray::reference {

CameraRays::CameraRays(const Camera& camera, const ImageSettings& image)
    : axes_(camera_axes(camera)), projection_(camera.projection), size_(image.size()) {}

Ray CameraRays::ray(const Vec2& place) const {
  const double x = 2.0 * place.x / size_.x - 1.0;
  const double y = (1.0 - 2.0 * place.y / size_.y) * (size_.y / size_.x);
  return projection_->ray(axes_, {x, y}, size_);
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
