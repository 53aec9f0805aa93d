// Surfaces on which paths choose points to be lit from.
#pragma once

#include <optional>
#include <variant>

#include "host/scene/affine.hpp"
#include "host/scene/light_bvh.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine {

struct ParallelogramForm {
  Vec3 corner, edge_u, edge_v;
};
struct EllipsoidForm {  // the unit sphere
  Mat4 to_world;
};
struct CylinderForm {  // x² + z² = 1 from y = −1 to 1, and, unless it is open, the caps
  Mat4 to_world;
  bool open;
};
using EmitterForm =
    std::variant<SphereForm, DiskForm, TriangleForm, ParallelogramForm, BoxForm, EllipsoidForm, CylinderForm>;

// Empty for a shape on which no point is chosen.
std::optional<EmitterForm> emitter_form(const ShapeForm& form);
EmitterForm mapped(const EmitterForm& form, const Affine& map);

// The area of one side of the form.
double area_of(const EmitterForm& form);
// True if its angles are so nearly right angles that points chosen on it as on a rectangle are uniform within
// float32.
bool is_rectangle(const ParallelogramForm& it);
// The share of a cylinder's area that its side has.
double share_of_side(const CylinderForm& cylinder);
// Without its power.
LightBounds bounds_of(const EmitterForm& form);
// True if the form lies in a plane. Below: its normal, by the right-hand rule from the first edge or axis to
// the second, and a point of it.
bool is_flat(const EmitterForm& form);
Vec3 normal_of(const EmitterForm& form);
Vec3 point_of(const EmitterForm& form);

}  // namespace eyeray::engine
