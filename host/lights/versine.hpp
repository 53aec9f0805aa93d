#pragma once

#include <cmath>

namespace eyeray::engine::lights {

// 1 − cos(angle), accurate also for small angles.
inline double versine(double angle) {
  return 2 * std::sin(angle / 2) * std::sin(angle / 2);
}

}  // namespace eyeray::engine::lights
