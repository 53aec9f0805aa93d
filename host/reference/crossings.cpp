#include "host/reference/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::reference {

Vec3 spawn_origin(const SurfacePoint& point, const Vec3& d, double least, bool along_normal,
                  Leaving leaving) {
  const double offset = std::max(4 * point.position_error, least);
  const double cosine = glm::dot(d, point.normal_geometric);
  if (leaving != Leaving::straight && point.lift.x >= 0) {
    const bool front = leaving == Leaving::in_front;
    const double up = front ? 1 : -1;
    const Vec3 start = point.position + up * (front ? point.lift.x : point.lift.y) * point.normal_side;
    if (!along_normal && up * cosine > 0.125) return start + d * (offset / (up * cosine));
    return start + up * offset * point.normal_geometric;
  }
  if (!along_normal && std::fabs(cosine) > 0.125) return point.position + d * (offset / std::fabs(cosine));
  return point.position + point.normal_geometric * (cosine >= 0 ? offset : -offset);
}

}  // namespace eyeray::reference
