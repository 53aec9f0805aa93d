// Shapes whose cross-sections are one curve at different sizes: surfaces of revolution, and superellipsoids.
#pragma once

#include <functional>
#include <vector>

#include "host/core/vec.hpp"
#include "host/raster/tessellation.hpp"

namespace eyeray::engine::raster {

// Points of a curve in order, and a bound on the curve's distance from the straight lines between them.
struct Polyline {
  std::vector<Vec2> points;
  double bound = 0;
};

// A point of a convex curve, and a vector perpendicular to the curve there, of any length; (0, 0) if there is
// none.
struct CurvePoint {
  Vec2 at, normal;
};
// Chords of the curve between parameters 0 and 1. The curve is halved until each piece is within `tolerance`
// of its chord: a convex arc lies between the chord and the tangents at its ends.
Polyline chords(const std::function<CurvePoint(double)>& curve, double tolerance);
// A circle's arc between two angles, around `center`.
Polyline arc(const Vec2& center, double radius, double from, double to, double tolerance);
// The parts one after the other; a point that ends one part and begins the next appears once.
Polyline joined(std::initializer_list<Polyline> parts);

// Combines every point (ρ, y) of `profile`, a distance from the axis and a height, with every point (x, z) of
// the closed `section` into a point (ρ x, y, ρ z). If ρ = 0, there is a single point. `closes`: the profile's
// last point is its first. The bound is in object space.
Tessellation sweep(const Polyline& profile, bool closes, const Polyline& section);

// The unit circle around the axis, as a section of a shape `reach` wide.
Polyline circle(double reach, double tolerance);

}  // namespace eyeray::engine::raster
