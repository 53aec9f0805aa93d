#include "scene/texture.hpp"

#include <cmath>

namespace eyeray {

Vec3 Texture::at(const Vec2& uv) const {
  if (!checker) return value;
  const double check = std::floor(uv.x / checker->size.x) + std::floor(uv.y / checker->size.y);
  return std::fmod(std::fabs(check), 2.0) < 0.5 ? checker->even : checker->odd;
}

}  // namespace eyeray
