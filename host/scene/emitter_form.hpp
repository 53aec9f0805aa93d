// The forms of surfaces on which paths sample points that light them.
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

// The emitter form of a shape; empty if paths sample no points on it.
std::optional<EmitterForm> emitter_form(const ShapeForm& form);
EmitterForm mapped(const EmitterForm& form, const Affine& map);

// The area of one side of the form.
double area_of(const EmitterForm& form);
// True if its angles are so close to right angles that sampling it as a rectangle is uniform within float32.
bool is_rectangle(const ParallelogramForm& it);
// The side's share of a cylinder's area.
double share_of_side(const CylinderForm& cylinder);
// The bounds of the form, without its power.
LightBounds bounds_of(const EmitterForm& form);
// True if the form lies in a plane.
bool is_flat(const EmitterForm& form);
// The normal of a flat form, by the right-hand rule from the first edge or axis to the second.
Vec3 normal_of(const EmitterForm& form);
// A point of a flat form; for any other form the centre of its bounds.
Vec3 point_of(const EmitterForm& form);

}  // namespace eyeray::engine
