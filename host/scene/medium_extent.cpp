#include "host/scene/medium_extent.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine {

bool MediumExtent::endless() const {
  const Bounds all = Bounds::unbounded();
  return min == all.min && max == all.max && std::isinf(scale_height);
}

bool MediumExtent::endless_towards(const Vec3& d) const {
  for (int axis = 0; axis < 3; ++axis)
    if (d[axis] != 0 && std::isfinite(d[axis] > 0 ? max[axis] : min[axis])) return false;
  return d.y <= 0 || std::isinf(scale_height);
}

Bounds MediumExtent::bounds() const {
  constexpr double most_scale_heights = 40;
  Bounds box{min, max};
  box.max.y = std::min(max.y, base + most_scale_heights * scale_height);
  return box;
}

}  // namespace eyeray::engine
