// Bicubic Bézier patches in float64: control points, points, parts.
#pragma once

#include <array>
#include <vector>

#include "host/core/vec.hpp"
#include "host/scene/bounds.hpp"

namespace eyeray::engine::shapes {

// The control points p₀₀ … p₃₃ of the patch Σ Bᵢ(v)·Bⱼ(u)·pᵢⱼ: four rows; u runs along a row.
using BezierNet = std::array<Vec3, 16>;

struct BezierPoint {
  Vec3 position;
  Vec3 along_u, along_v;  // derivatives
};
BezierPoint bezier_point(const BezierNet& net, double u, double v);

// A rectangle in u and v.
struct BezierRange {
  Vec2 from{0.0}, to{1.0};
};
// The control points of the part of the patch in `range`, as if it were a whole patch.
BezierNet bezier_part(const BezierNet& net, const BezierRange& range);

// A piece of a patch: rays are tested against one piece at a time (shaders/shapes/bezier.glsl). It is so flat
// that any plane across it cuts it in one arc, almost without inflection.
struct BezierPiece {
  BezierRange range;
  Vec3 middle;
  double radius;  // radius of a ball around `middle` that holds the piece
  Vec3 normal;    // along ∂u × ∂v, unit
  double beyond;  // share of its size by which the search for a hit goes beyond its borders; 2: it is a
                  // speck, tested as a disk
  Bounds bounds;
};
// The pieces of the whole patch, at most some thousands. A piece is flat enough if its derivatives vary by
// less than a third of their values in its middle. At points where the patch has no normal, pieces become as
// small as 2⁻¹⁴ of it instead.
std::vector<BezierPiece> bezier_pieces(const BezierNet& net);

}  // namespace eyeray::engine::shapes
