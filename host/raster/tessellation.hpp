// Shapes as triangles, from the forms that they state (scene/shape.hpp).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/scene/shape.hpp"

namespace eyeray::engine::raster {

// The triangles of a shape, in the world unless stated otherwise.
struct Tessellation {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;
  double bound = 0;  // the largest distance of the surface from the triangles, and of them from the surface
};

// A ball around a shape, in the world.
struct Ball {
  Vec3 center;
  double radius;
};
// The ball around a box under `map`; empty for an unbounded box.
std::optional<Ball> ball_around(const Bounds& bounds, const Mat4& map);

// Tessellates `form` under `map`. The bound is about `tolerance` unless that takes more triangles than a
// picture has pixels; it is 0 for flat forms. Empty for forms that are not tessellated: quadrics that are not
// round, CSG objects, and shapes without a form. Planes have no end, and are cut to the picture instead
// (View::plane).
std::optional<Tessellation> tessellate(const ShapeForm& form, const Mat4& map, double tolerance);

}  // namespace eyeray::engine::raster
