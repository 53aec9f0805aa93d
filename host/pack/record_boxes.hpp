// Boxes around records' primitives, whose coordinates are rounded.
#pragma once

#include <utility>

#include "host/bvh/box.hpp"
#include "host/records/records.hpp"
#include "host/scene/bounds.hpp"

namespace eyeray::engine::pack {

// The box of a shape with these bounds, packed relative to `origin`.
bvh::Box shape_box(const Bounds& bounds, const Vec3& origin);

// The boxes of the parts of a triangle below and above the plane at `position` across `axis`.
std::pair<bvh::Box, bvh::Box> cut_triangle(const shader::Primitive& triangle, int axis, float position);

// The box in the world around all corners of `local`, a box in the instance's space.
bvh::Box instance_box(const shader::Instance& instance, const bvh::Box& local);

}  // namespace eyeray::engine::pack
