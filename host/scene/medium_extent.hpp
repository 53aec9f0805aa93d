// The extent of the medium that is around all shapes: everywhere, in a box, below a height, or exponential
// height fog, whose density falls by 1/e with every `scale_height`.
#pragma once

#include "host/scene/bounds.hpp"

namespace eyeray::engine {

struct MediumExtent {
  Vec3 min = Bounds::unbounded().min;  // corners of the box, whose sides may be infinitely far away
  Vec3 max = Bounds::unbounded().max;
  // At height y the medium has exp((base − y) / scale_height) times the coefficients that the scene states.
  double scale_height = std::numeric_limits<double>::infinity();
  double base = 0;

  // True if the medium fills all space evenly.
  bool endless() const;
  // True if a ray in direction d, from a point of the medium, never leaves it.
  bool endless_towards(const Vec3& d) const;
  // The box to which all executors confine the medium: from min to max, without the part more than 40 scale
  // heights above `base`, where the density is below 1e-17.
  Bounds bounds() const;
};

}  // namespace eyeray::engine
