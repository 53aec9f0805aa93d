#include "host/raster/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <span>

#include "host/raster/flat_regions.hpp"
#include "host/raster/patch.hpp"
#include "host/raster/sweep.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::raster {
namespace {

constexpr double half_turn = std::numbers::pi;

// The largest factor by which the map lengthens a vector, by Gershgorin's circles about the Gram matrix:
// exact if the map keeps the axes perpendicular to each other.
double stretch(const Mat4& map) {
  const Mat3 linear(map), gram = glm::transpose(linear) * linear;
  double most = 0;
  for (int i = 0; i < 3; ++i)
    most = std::max(most, std::fabs(gram[i].x) + std::fabs(gram[i].y) + std::fabs(gram[i].z));
  return std::sqrt(most);
}

Mat4 sphere_map(const SphereForm& form) {
  return glm::translate(Mat4(1.0), form.center) * Mat4(form.axes * form.radius);
}

// An arc of the circle around (0, middle), from angle `from` to `to` above the horizontal. Ends that belong
// on the axis are exactly on it.
Polyline meridian(double middle, double from, double to, double tolerance, double radius = 1) {
  Polyline line = arc({0, middle}, radius, from, to, tolerance);
  if (from == -half_turn / 2) line.points.front() = {0, middle - radius};
  if (to == half_turn / 2) line.points.back() = {0, middle + radius};
  return line;
}

Polyline straight(std::vector<Vec2> points) {
  return {std::move(points), 0};
}

Tessellation ball(double tolerance) {
  return sweep(meridian(0, -half_turn / 2, half_turn / 2, tolerance / 2), false, circle(1, tolerance / 2));
}

// The surface x² + z² = square·y² + 2·linear·y + constant between two heights.
struct RoundQuadric {
  double square, linear, constant, bottom, top;

  double radius(double y) const { return std::sqrt(std::max((square * y + 2 * linear) * y + constant, 0.0)); }
  double widest() const {
    double most = std::max(radius(bottom), radius(top));
    const double middle = square < 0 ? -linear / square : bottom;
    return middle > bottom && middle < top ? std::max(most, radius(middle)) : most;
  }
};

// The quadric as a surface of revolution about y. Empty if it is not such a surface, or if its clip cuts its
// sides.
std::optional<RoundQuadric> round_quadric(const QuadricForm& form) {
  const bool is_round = form.square.x == 1 && form.square.z == 1 && form.product == Vec3(0) &&
                        form.linear.x == 0 && form.linear.z == 0;
  if (!is_round) return std::nullopt;
  RoundQuadric round{-form.square.y, -form.linear.y / 2, -form.constant, form.clip.min.y, form.clip.max.y};
  if (round.square < 0) {
    // A closed surface ends by itself.
    const double middle = -round.linear / round.square,
                 reach = std::sqrt(std::max(middle * middle - round.constant / round.square, 0.0));
    round.bottom = std::max(round.bottom, middle - reach);
    round.top = std::min(round.top, middle + reach);
  }
  const double side =
      std::min(std::min(form.clip.max.x, -form.clip.min.x), std::min(form.clip.max.z, -form.clip.min.z));
  if (!(round.bottom < round.top) || !(round.widest() < side)) return std::nullopt;
  return round;
}

Tessellation round_body(const RoundQuadric& round, const QuadricForm& form, double tolerance) {
  // An ellipsoid is the unit sphere, mapped.
  if (round.square == -1 && round.linear == 0 && round.constant == 1 && round.bottom == -1 && round.top == 1)
    return ball(tolerance);
  // The discriminant shows whether the profile is straight; else it bends to one side throughout.
  const double bend = round.square * round.constant - round.linear * round.linear;
  const double size = std::fabs(round.square * round.constant) + round.linear * round.linear;
  const auto height = [&](double s) {
    return s == 1 ? round.top : round.bottom + s * (round.top - round.bottom);
  };
  const auto curve = [&](double s) {
    const double y = height(s), radius = round.radius(y);
    return CurvePoint{{radius, y}, {radius, -(round.square * y + round.linear)}};
  };
  const Vec2 low(round.radius(round.bottom), round.bottom), high(round.radius(round.top), round.top);
  const bool is_straight = std::fabs(bend) <= 1e-12 * size;
  const Polyline side = is_straight ? straight({low, high}) : chords(curve, tolerance / 2);
  const bool capped = !form.open;
  const bool low_cap = capped && round.bottom == form.clip.min.y,
             high_cap = capped && round.top == form.clip.max.y;
  const Polyline profile = joined({low_cap ? straight({{0, round.bottom}, low}) : straight({low}), side,
                                   high_cap ? straight({high, {0, round.top}}) : straight({high})});
  return sweep(profile, false, circle(round.widest(), tolerance / 2));
}

// A quarter of the curve |a|^p + |b|^p = 1, by angle. It begins `quarter` quarter turns after (1, 0). A
// profile of points (ρ, y) begins at (0, −1), a section of points (x, z) at (1, 0).
Polyline superellipse_quarter(double p, int quarter, double tolerance) {
  const auto curve = [&](double s) {
    const double angle = s * half_turn / 2;
    Vec2 at(std::cos(angle), std::sin(angle));
    if (s == 1) at = {0, 1};
    at /= std::pow(std::pow(at.x, p) + std::pow(at.y, p), 1 / p);
    Vec2 normal(std::pow(at.x, p - 1), std::pow(at.y, p - 1));
    for (int i = 0; i < quarter; ++i) at = {-at.y, at.x}, normal = {-normal.y, normal.x};
    return CurvePoint{at + 0.0, normal};
  };
  return chords(curve, tolerance);
}

Tessellation superellipsoid(const SuperellipsoidForm& form, double tolerance) {
  Polyline section = joined({superellipse_quarter(2 / form.e, 0, tolerance / 3),
                             superellipse_quarter(2 / form.e, 1, tolerance / 3),
                             superellipse_quarter(2 / form.e, 2, tolerance / 3),
                             superellipse_quarter(2 / form.e, 3, tolerance / 3)});
  section.points.pop_back();
  return sweep(joined({superellipse_quarter(2 / form.n, 3, tolerance / 3),
                       superellipse_quarter(2 / form.n, 0, tolerance / 3)}),
               false, section);
}

// A form's triangles in object space, and the map from object space.
struct Piece {
  Tessellation tessellation;
  Mat4 map{1.0};
  bool in_world = false;  // the triangles are in the world already: no map is applied
};

struct Tessellator {
  const Mat4& map;
  double tolerance;

  using Result = std::optional<Piece>;
  double own(const Mat4& form_map) const { return tolerance / stretch(map * form_map); }

  Result operator()(const std::monostate&) const { return std::nullopt; }
  Result operator()(const PlaneForm&) const { return std::nullopt; }
  Result operator()(const CsgForm&) const { return std::nullopt; }

  Result operator()(const SphereForm& form) const {
    const Mat4 to_world = sphere_map(form);
    return Piece{ball(own(to_world)), to_world};
  }
  Result operator()(const TriangleForm& form) const {
    return Piece{{{form.vertices.begin(), form.vertices.end()}, {{0, 1, 2}}, 0}};
  }
  Result operator()(const BoxForm& form) const {
    Tessellation cube;
    for (int corner = 0; corner < 8; ++corner)
      cube.points.push_back({corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1});
    cube.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
    return Piece{std::move(cube), form.to_world};
  }
  Result operator()(const DiskForm& form) const {
    return Piece{sweep(straight({{form.inner, 0}, {1, 0}}), false, circle(1, own(form.to_world))),
                 form.to_world};
  }
  Result operator()(const CapsuleForm& form) const {
    const double each = own(form.to_world) / 2;
    const double side = form.half > 0 ? std::asin((form.low - form.high) / (2 * form.half)) : 0;
    const Polyline profile = joined({meridian(-form.half, -half_turn / 2, side, each, form.low),
                                     meridian(form.half, side, half_turn / 2, each, form.high)});
    return Piece{sweep(profile, false, circle(1, each)), form.to_world};
  }
  Result operator()(const QuadricForm& form) const {
    const auto round = round_quadric(form);
    if (!round) return std::nullopt;
    return Piece{round_body(*round, form, own(form.to_world)), form.to_world};
  }
  Result operator()(const TorusForm& form) const {
    const double each = own(form.to_world) / 2;
    Polyline tube = arc({1, 0}, form.minor, 0, 2 * half_turn, each);
    tube.points.back() = tube.points.front();
    return Piece{sweep(tube, true, circle(1 + form.minor, each)), form.to_world};
  }
  Result operator()(const SuperellipsoidForm& form) const {
    return Piece{superellipsoid(form, own(form.to_world)), form.to_world};
  }
  Result operator()(const PolygonForm& form) const {
    Piece piece;
    add_region(form.outlines, piece.tessellation.points, piece.tessellation.triangles);
    return piece;
  }
  Result operator()(const ExtrusionForm& form) const {
    Piece piece{{}, form.to_world};
    Tessellation& prism = piece.tessellation;
    for (const double y : {-1.0, 1.0}) {
      std::vector<std::vector<Vec3>> cap;
      for (const auto& outline : form.outlines) {
        cap.emplace_back();
        for (const Vec2& p : outline) cap.back().push_back({p.x, y, p.y});
      }
      add_region(cap, prism.points, prism.triangles);
    }
    for (const auto& outline : form.outlines) {
      for (size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        add_region({{{a.x, -1, a.y}, {b.x, -1, b.y}, {b.x, 1, b.y}, {a.x, 1, a.y}}}, prism.points,
                   prism.triangles);
      }
    }
    return piece;
  }
  // The map applies to the patch's points themselves; there is no object space.
  Result operator()(const BezierForm& form) const {
    std::array<Vec3, 16> net = form.net;
    for (Vec3& point : net) point = Vec3(map * Vec4(point, 1.0));
    return Piece{tessellate_patch(net, tolerance), Mat4(1.0), true};
  }
};

// A ball around points.
Ball around(std::span<const Vec3> points) {
  Bounds bounds;
  for (const Vec3& point : points) bounds.include(point);
  const Vec3 middle = (bounds.min + bounds.max) / 2.0;
  double radius = 0;
  for (const Vec3& point : points) radius = std::max(radius, glm::length(point - middle));
  return {middle, radius};
}

}  // namespace

std::optional<Ball> ball_around(const Bounds& bounds, const Mat4& map) {
  if (!(glm::length(bounds.max - bounds.min) < std::numeric_limits<double>::infinity())) return std::nullopt;
  std::array<Vec3, 8> corners;
  for (size_t corner = 0; corner < 8; ++corner)
    corners[corner] =
        Vec3(map * Vec4(corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                        corner & 4 ? bounds.max.z : bounds.min.z, 1.0));
  return around(corners);
}

std::optional<Tessellation> tessellate(const ShapeForm& form, const Mat4& map, double tolerance) {
  std::optional<Piece> piece = std::visit(Tessellator{map, tolerance}, form);
  if (!piece) return std::nullopt;
  if (piece->in_world) return std::move(piece->tessellation);
  const Mat4 to_world = map * piece->map;
  for (Vec3& point : piece->tessellation.points) point = Vec3(to_world * Vec4(point, 1.0));
  piece->tessellation.bound *= stretch(to_world);
  return std::move(piece->tessellation);
}

}  // namespace eyeray::engine::raster
