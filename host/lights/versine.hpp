#pragma once

#include <cmath>

namespace eyeray::engine::lights {

// One less the cosine, also of small angles.
inline double versine(double angle) {
  return 2 * std::sin(angle / 2) * std::sin(angle / 2);
}

}  // namespace eyeray::engine::lights
