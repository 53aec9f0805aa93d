#pragma once

#include <limits>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// An axis-aligned box; infinite extents for unbounded shapes.
struct Bounds {
  Vec3 min{std::numeric_limits<double>::infinity()};
  Vec3 max{-std::numeric_limits<double>::infinity()};

  static Bounds unbounded() {
    return {-Vec3(std::numeric_limits<double>::infinity()), Vec3(std::numeric_limits<double>::infinity())};
  }
  void include(const Vec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
};

}  // namespace eyeray::engine
