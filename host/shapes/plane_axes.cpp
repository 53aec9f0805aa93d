#include "host/shapes/plane_axes.hpp"

#include <cmath>

#include "host/scene/affine.hpp"

namespace eyeray::engine::shapes {

namespace {

Vec3 default_u_axis(const Vec3& normal) {
  const bool vertical = std::hypot(normal.x, normal.z) < 1e-6;
  return vertical ? Vec3(1, 0, 0) : Vec3(normal.z, 0, -normal.x);
}

}  // namespace

Vec3 tangential(const Vec3& v, const Vec3& normal) {
  return v - normal * glm::dot(v, normal);
}

PlaneAxes plane_axes(const Vec3& normal, const std::optional<Vec3>& u_axis) {
  const Vec3 u = unit(tangential(u_axis ? unit(*u_axis) : default_u_axis(normal), normal));
  return {u, glm::cross(normal, u)};
}

const char* why_no_u_axis(const Vec3& normal, const Vec3& u_axis) {
  if (u_axis == Vec3(0)) return "the axis has no length";
  if (magnitude(tangential(unit(u_axis), unit(normal))) < 1e-9)
    return "the axis must not be parallel to the normal";
  return "";
}

}  // namespace eyeray::engine::shapes
