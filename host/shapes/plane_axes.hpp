// The axes of u and v in a plane, for shapes whose uv are distances in it.
#pragma once

#include <optional>

#include "host/core/vec.hpp"

namespace eyeray::engine::shapes {

// Unit, with (u, v, normal) right-handed.
struct PlaneAxes {
  Vec3 u;
  Vec3 v;
};

// The component of `v` perpendicular to the unit `normal`.
Vec3 tangential(const Vec3& v, const Vec3& normal);

// `normal` is unit. u runs along `u_axis`, as far as it lies in the plane; without one it is horizontal, +y ×
// normal, or where the normal is vertical (its x and z below 1e-6) +x.
PlaneAxes plane_axes(const Vec3& normal, const std::optional<Vec3>& u_axis = {});

// Why `u_axis` cannot be one, or "".
const char* why_no_u_axis(const Vec3& normal, const Vec3& u_axis);

}  // namespace eyeray::engine::shapes
