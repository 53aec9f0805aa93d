#include "host/shapes/spline.hpp"

#include <algorithm>
#include <iterator>

namespace eyeray::engine::shapes {

namespace {

// From a point and the derivative at both ends.
CubicCurve hermite(const Vec4& from, const Vec4& from_slope, const Vec4& to, const Vec4& to_slope) {
  return {{from, from + from_slope / 3.0, to - to_slope / 3.0, to}};
}

constexpr SplineKind spline_kinds[] = {
    {"linear", 2, 1,
     [](std::span<const Vec4> p) {
       return CubicCurve{{p[0], (2.0 * p[0] + p[1]) / 3.0, (p[0] + 2.0 * p[1]) / 3.0, p[1]}};
     }},
    // The second half of the parabola that passes three points at s = −1, 0 and 1.
    {"quadratic", 3, 1,
     [](std::span<const Vec4> p) {
       return hermite(p[1], 0.5 * (p[2] - p[0]), p[2], 0.5 * p[0] - 2.0 * p[1] + 1.5 * p[2]);
     }},
    {"cubic", 4, 1,
     [](std::span<const Vec4> p) { return hermite(p[1], 0.5 * (p[2] - p[0]), p[2], 0.5 * (p[3] - p[1])); }},
    {"b_spline", 4, 1,
     [](std::span<const Vec4> p) {
       return CubicCurve{{(p[0] + 4.0 * p[1] + p[2]) / 6.0, (2.0 * p[1] + p[2]) / 3.0,
                          (p[1] + 2.0 * p[2]) / 3.0, (p[1] + 4.0 * p[2] + p[3]) / 6.0}};
     }},
    {"bezier", 4, 4, [](std::span<const Vec4> p) { return CubicCurve{{p[0], p[1], p[2], p[3]}}; }},
};

}  // namespace

Vec4 CubicCurve::at(double s) const {
  const double r = 1 - s;
  return r * r * r * p[0] + 3 * r * r * s * p[1] + 3 * r * s * s * p[2] + s * s * s * p[3];
}

Vec4 CubicCurve::derivative(double s) const {
  const double r = 1 - s;
  return 3 * r * r * (p[1] - p[0]) + 6 * r * s * (p[2] - p[1]) + 3 * s * s * (p[3] - p[2]);
}

CubicCurve CubicCurve::part(double from, double to) const {
  const double width = to - from;
  return hermite(at(from), width * derivative(from), at(to), width * derivative(to));
}

const SplineKind* find_spline(std::string_view name) {
  const auto found = std::ranges::find(spline_kinds, name, &SplineKind::name);
  return found == std::end(spline_kinds) ? nullptr : found;
}

std::vector<CubicCurve> spline_curves(const SplineKind& kind, std::span<const Vec4> points) {
  std::vector<CubicCurve> curves;
  for (size_t i = 0; i + kind.least <= points.size(); i += kind.step)
    curves.push_back(kind.segment(points.subspan(i, kind.least)));
  return curves;
}

}  // namespace eyeray::engine::shapes
