// The float64 intersection that spheres and points share.
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include "host/core/vec.hpp"

namespace eyeray::engine::shapes {

// The two t at which a line crosses the sphere around `center`, the lower first; empty if it misses.
inline std::optional<std::pair<double, double>> sphere_roots(const Vec3& center, double radius,
                                                             const Ray& ray) {
  // Compute the discriminant from the point of the ray's line that is nearest to the centre.
  const Vec3 f = ray.o - center;
  const double a = glm::dot(ray.d, ray.d);
  const double b = -glm::dot(f, ray.d);
  const Vec3 nearest = f + ray.d * (b / a);
  const double discriminant = radius * radius - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return std::nullopt;

  // Form both roots without cancellation: q has the sign of b.
  const double q = b + std::copysign(std::sqrt(a * discriminant), b);
  const double c = glm::dot(f, f) - radius * radius;
  double near = c / q;
  double far = q / a;
  if (!(near <= far)) std::swap(near, far);
  return std::pair(near, far);
}

}  // namespace eyeray::engine::shapes
