// Boxes around what records say, whose coordinates are rounded.
#pragma once

#include <utility>

#include "accel/box.hpp"
#include "records/records.hpp"
#include "scene/bounds.hpp"

namespace eyeray {

// Of a shape with these bounds, packed relative to `origin`.
accel::Box shape_box(const Bounds& bounds, const Vec3& origin);

// Of what is below and above a plane, of a triangle.
std::pair<accel::Box, accel::Box> cut_triangle(const shader::Primitive& triangle, int axis, float position);

// In the world, around all corners of a box of the instance's space.
accel::Box instance_box(const shader::Instance& instance, const accel::Box& local);

}  // namespace eyeray
