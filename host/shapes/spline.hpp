// Curves through or along given points, as POV-Ray's splines are: for sphere sweeps and lathes.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::shapes {

// A cubic Bézier curve: Σ Bᵢ(s)·pᵢ for s from 0 to 1, with Bernstein's polynomials B of degree 3.
struct CubicCurve {
  std::array<Vec4, 4> p;

  Vec4 at(double s) const;
  Vec4 derivative(double s) const;
  // The part from `from` to `to`.
  CubicCurve part(double from, double to) const;
};

// A kind of spline: how many points it needs at least, and how many more each further segment takes.
struct SplineKind {
  std::string_view name;
  size_t least;
  size_t step = 1;
  // The curve of a segment; `p` are its points, `least` in number.
  CubicCurve (*segment)(std::span<const Vec4> p);
};

// linear, quadratic, cubic (Catmull and Rom), b_spline (uniform) and bezier. Null for any other name.
const SplineKind* find_spline(std::string_view name);

// The segments in order. The number of points must fit the kind.
std::vector<CubicCurve> spline_curves(const SplineKind& kind, std::span<const Vec4> points);

}  // namespace eyeray::engine::shapes
