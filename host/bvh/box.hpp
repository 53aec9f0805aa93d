// Boxes in float32, as the shaders see the world.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace eyeray::engine::bvh {

struct Box {
  glm::vec3 lower{std::numeric_limits<float>::infinity()};
  glm::vec3 upper{-std::numeric_limits<float>::infinity()};

  void include(const glm::vec3& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void include(const Box& box) {
    lower = glm::min(lower, box.lower);
    upper = glm::max(upper, box.upper);
  }
  Box intersection(const Box& box) const { return {glm::max(lower, box.lower), glm::min(upper, box.upper)}; }
  // Half the box's surface area.
  double area() const {
    const glm::dvec3 size(upper - lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
  bool is_finite() const {
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(lower[axis]) || !std::isfinite(upper[axis])) return false;
    return true;
  }
};

}  // namespace eyeray::engine::bvh
