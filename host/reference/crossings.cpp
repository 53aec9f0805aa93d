#include "host/reference/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::reference {

Vec3 spawn_origin(const SurfacePoint& point, const Vec3& d, double least, bool along_normal) {
  const double offset = std::max(4 * point.position_error, least);
  const double cosine = glm::dot(d, point.normal_geometric);
  if (!along_normal && std::fabs(cosine) > 0.125) return point.position + d * (offset / std::fabs(cosine));
  return point.position + point.normal_geometric * (cosine >= 0 ? offset : -offset);
}

}  // namespace eyeray::reference
