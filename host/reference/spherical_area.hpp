// Triangles and rectangles as a point sees them, on the sphere of directions around it: in float64, by their
// angles.
#pragma once

#include <array>

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

// A triangle. `corners`: relative to the point that sees it. Arvo: Stratified Sampling of Spherical
// Triangles, SIGGRAPH 1995.
class SphericalTriangle {
 public:
  explicit SphericalTriangle(const std::array<Vec3, 3>& corners);

  double solid_angle() const { return solid_angle_; }
  // A unit direction to the triangle. u: two numbers in [0, 1). The second one runs along the edge opposite
  // the first corner.
  Vec3 direction(const Vec2& u) const;

 private:
  std::array<Vec3, 3> corners_;  // as directions
  double angle_;                 // at the second corner
  double solid_angle_;
};

// A rectangle. `corner`: relative to the point that sees it. Ureña, Fajardo, King: An Area-Preserving
// Parametrization for Spherical Rectangles, EGSR 2013.
class SphericalRectangle {
 public:
  SphericalRectangle(const Vec3& corner, const Vec3& edge_u, const Vec3& edge_v);

  double solid_angle() const { return solid_angle_; }
  // A point, as its shares of the two edges in [0, 1]. u: two numbers in [0, 1) that choose it.
  Vec2 position(const Vec2& u) const;

 private:
  Vec3 low_, high_;  // opposite corners in the rectangle's own space; both z are the same, and negative
  double b0_, b1_, k_;
  double solid_angle_;
};

}  // namespace eyeray::engine::reference
