// Bicubic Bézier patches in float64: control points, points, parts.
#pragma once

#include <array>
#include <vector>

#include "host/core/vec.hpp"
#include "host/scene/bounds.hpp"

namespace eyeray::engine::shapes {

// p₀₀ … p₃₃ of Σ Bᵢ(v)·Bⱼ(u)·pᵢⱼ: four rows, u running along them.
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
// The control points of that part of the patch, as if it were a whole one.
BezierNet bezier_part(const BezierNet& net, const BezierRange& range);

// The piece of a patch that a ray is tested against at a time (shaders/shapes/bezier.glsl). It is so flat
// that it crosses any plane across it in one arc, almost without inflection.
struct BezierPiece {
  BezierRange range;
  Vec3 middle;
  double radius;  // of a ball around `middle` that holds the piece
  Vec3 normal;    // along ∂u × ∂v, unit
  double beyond;  // by which share of its size the search for a hit goes beyond its borders; 2: it is a
                  // speck, tested as a disk
  Bounds bounds;
};
// All of the patch. Flat enough where the derivatives vary by less than a third of their values in the
// middle, or else as small as 2⁻¹⁴ of it: at points where it has no normal. At most some thousands.
std::vector<BezierPiece> bezier_pieces(const BezierNet& net);

}  // namespace eyeray::engine::shapes
