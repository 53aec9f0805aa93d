#include "host/raster/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace eyeray::engine::raster {
namespace {

constexpr int least_sides = 8, most_sides = 1024;
constexpr int deepest = 24;

// The distance between the chord and the point where the tangents at its ends intersect. 0 for a straight
// piece. The chord's length if a tangent is unknown, or perpendicular to the chord or beyond.
double sagitta(const CurvePoint& a, const CurvePoint& b) {
  const Vec2 chord = b.at - a.at;
  const double length = glm::length(chord);
  if (length == 0) return 0;
  const auto rise = [&](const Vec2& normal) {  // the tangent of the angle between curve and chord
    const double along = std::fabs(normal.x * chord.y - normal.y * chord.x),
                 across = std::fabs(glm::dot(normal, chord));
    return along > 0 ? across / along : std::numeric_limits<double>::infinity();
  };
  const double at_a = rise(a.normal), at_b = rise(b.normal);
  if (std::isinf(at_a) || std::isinf(at_b)) return length;
  return at_a + at_b > 0 ? length * at_a * at_b / (at_a + at_b) : 0;
}

void halve(const std::function<CurvePoint(double)>& curve, double from, const CurvePoint& a, double to,
           const CurvePoint& b, double tolerance, int depth, Polyline& line) {
  const double across = sagitta(a, b);
  if (across > tolerance && depth < deepest) {
    const double middle = (from + to) / 2;
    const CurvePoint between = curve(middle);
    halve(curve, from, a, middle, between, tolerance, depth + 1, line);
    halve(curve, middle, between, to, b, tolerance, depth + 1, line);
    return;
  }
  line.bound = std::max(line.bound, across);
  line.points.push_back(b.at);
}

// The number of parts into which an arc is cut.
int parts(double radius, double angle, double tolerance) {
  const double share = std::clamp(1 - tolerance / radius, -1.0, 1.0);
  const double each = 2 * std::acos(share);
  const double count = each > 0 ? std::ceil(angle / each) : most_sides;
  const double whole = 2 * std::numbers::pi / angle;
  return int(std::clamp(count, least_sides / whole, most_sides / whole));
}

}  // namespace

Polyline chords(const std::function<CurvePoint(double)>& curve, double tolerance) {
  const CurvePoint first = curve(0), last = curve(1);
  Polyline line{{first.at}, 0};
  halve(curve, 0, first, 1, last, tolerance, 0, line);
  return line;
}

Polyline arc(const Vec2& center, double radius, double from, double to, double tolerance) {
  const int count = std::max(parts(radius, std::fabs(to - from), tolerance), 1);
  Polyline line;
  for (int i = 0; i <= count; ++i) {
    const double angle = from + (to - from) * i / count;
    line.points.push_back(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  line.bound = radius * (1 - std::cos((to - from) / count / 2));
  return line;
}

Polyline circle(double reach, double tolerance) {
  Polyline line = arc({0, 0}, 1, 0, 2 * std::numbers::pi, tolerance / reach);
  line.points.pop_back();
  return line;
}

Polyline joined(std::initializer_list<Polyline> parts) {
  Polyline line;
  for (const Polyline& part : parts) {
    for (const Vec2& point : part.points)
      if (line.points.empty() || line.points.back() != point) line.points.push_back(point);
    line.bound = std::max(line.bound, part.bound);
  }
  return line;
}

Tessellation sweep(const Polyline& profile, bool closes, const Polyline& section) {
  const auto sides = uint32_t(section.points.size());
  Tessellation result;
  double widest = 0, reach = 1;
  for (const Vec2& point : section.points) reach = std::max(reach, glm::length(point));

  // A ring for each point of the profile: a single point if it is on the axis.
  struct Ring {
    uint32_t first;
    bool is_point;
    uint32_t at(uint32_t side) const { return is_point ? first : first + side; }
  };
  std::vector<Ring> rings;
  const size_t count = profile.points.size() - (closes ? 1 : 0);
  for (size_t i = 0; i < count; ++i) {
    const Vec2& p = profile.points[i];
    rings.push_back({uint32_t(result.points.size()), p.x == 0});
    widest = std::max(widest, p.x);
    if (p.x == 0) result.points.push_back({0, p.y, 0});
    for (const Vec2& s : section.points)
      if (p.x != 0) result.points.push_back({p.x * s.x, p.y, p.x * s.y});
  }
  if (closes) rings.push_back(rings.front());

  for (size_t i = 0; i + 1 < rings.size(); ++i) {
    for (uint32_t side = 0; side < sides; ++side) {
      const uint32_t next = (side + 1) % sides;
      const uint32_t a = rings[i].at(side), b = rings[i].at(next), c = rings[i + 1].at(next),
                     d = rings[i + 1].at(side);
      if (a != b) result.triangles.push_back({a, b, c});
      if (c != d) result.triangles.push_back({a, c, d});
    }
  }
  // The strip between two rings consists of plane pieces, one for each chord of the section.
  result.bound = widest * section.bound + reach * profile.bound;
  return result;
}

}  // namespace eyeray::engine::raster
