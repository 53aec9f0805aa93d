#pragma once

#include "host/core/vec.hpp"

namespace eyeray::engine {

// The luminance of linear RGB with the primaries of Rec. 709.
inline double luminance(const Vec3& color) {
  return glm::dot(color, Vec3(0.2126, 0.7152, 0.0722));
}

}  // namespace eyeray::engine
