// The axes of u and v in a plane, for shapes whose uv are distances in it.
#pragma once

#include <optional>

#include "host/core/vec.hpp"

namespace eyeray::engine::shapes {

// Unit vectors, with (u, v, normal) right-handed.
struct PlaneAxes {
  Vec3 u;
  Vec3 v;
};

// The component of `v` perpendicular to the unit `normal`.
Vec3 tangential(const Vec3& v, const Vec3& normal);

// `normal` is unit. u runs along the component of `u_axis` in the plane. Without `u_axis`, u is horizontal:
// +y × normal, or +x if the normal is vertical (its x and z below 1e-6).
PlaneAxes plane_axes(const Vec3& normal, const std::optional<Vec3>& u_axis = {});

// The reason why `u_axis` cannot set the direction of u, or "".
const char* why_no_u_axis(const Vec3& normal, const Vec3& u_axis);

}  // namespace eyeray::engine::shapes
