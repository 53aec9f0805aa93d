#include "host/reference/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::reference {

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

Vec3 way_inside(const SurfacePoint& point, double room) {
  const auto& edges = point.edges;
  const double area = glm::length(glm::cross(edges[0], edges[1]));
  if (!(area > 0)) return Vec3(0);
  const auto missing = [&](int corner) {
    return std::min(room * glm::length(edges[size_t(corner + 1) % 3]) / area, 0.25) -
           point.weights[corner % 3];
  };
  int worst = 0;
  const auto distance = [&](int corner) {
    return missing(corner) / glm::length(edges[size_t(corner + 1) % 3]);
  };
  for (const int corner : {1, 2})
    if (distance(corner) > distance(worst)) worst = corner;
  const Vec3 up = edges[size_t(worst + 2) % 3], along = -edges[size_t(worst + 1) % 3];
  const double rise = std::max(missing(worst), 0.0);
  const double least = missing((worst + 1) % 3), most = -missing((worst + 2) % 3) - rise;
  const double slide = -rise * glm::dot(up, along) / glm::dot(along, along);
  return up * rise + along * std::min(std::max(slide, least), most);
}

}  // namespace eyeray::engine::reference
