#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/bezier.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/pieces.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/spline.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(The surface that a curve sweeps when it turns about the y axis, as POV-Ray's lathe: a vase, a bowl, a chess piece.
It is one object, with one id. Each of `points` is a distance from the axis and a height, [r, y], and `spline` is the
curve through or along these points:

| `spline` | curve | points |
| --- | --- | --- |
| `"linear"` | straight pieces from point to point | 2 or more |
| `"quadratic"` | pieces of parabolas through all points but the first, which sets the direction at the start | 3 or more |
| `"cubic"` | Catmull and Rom's: through all points but the first and the last, which set the direction at the ends | 4 or more |
| `"bezier"` | cubic Bézier curves, of four points each | 4, 8, 12, … |

```toml
[[lathe]]
points = [[0, 0], [0.5, 0], [0.9, 0.3], [0.5, 0.9], [0.5, 0.9], [0.3, 1.2], [0.35, 1.4], [0.5, 1.6]]
spline = "bezier"
material = "wall"
```

Open; the normal points to the right of the curve, with r to the right and y up. So it points outward where the curve
rises. A curve of which both ends are on the axis, or which is closed, encloses a volume, and may be of glass. A
shadow ray through an edge of two patches may count that crossing twice. The curve must not cross the axis. `transform` may be any invertible affine map. Each crossing multiplies the light of
a shadow ray by √`shadow`, as for a [Bézier patch](#bezier).

**Pieces.** The surface consists of [Bézier patches](#bezier), one for each segment of the curve and each eighth of a
turn. They describe the curve exactly. An eighth of a circle, as a cubic curve, is off it by at most 4.3e-6 of the
radius. That is less than a hundredth of a pixel for circles of up to 4000 pixels. Normals of patches
beside each other agree. A patch finds its hits by searches that the pictures of the teapot have proven, and a surface
of degree six in each segment would need a search of its own.

**uv.** u runs from 0 to 1 about the axis, counter-clockwise seen from above. u = ½ is towards +x. It is
the angle up to 2e-4 of a turn. v runs from 0 to 1 along the curve, and increases on each segment by its share of the
control points' distances.

**Source.** POV-Ray 3.7, reference, section 3.4.5.1.7 (Lathe).
)";

constexpr std::string_view columns[] = {"r", "y"};
constexpr std::string_view splines[] = {"linear", "quadratic", "cubic", "bezier"};

constexpr Key keys[] = {
    {.name = "points",
     .type = KeyType::rows,
     .doc = "Points of the curve: distance from the axis, and height.",
     .min = -max_coordinate,
     .max = max_coordinate,
     .choices = columns},
    {.name = "spline",
     .type = KeyType::choice,
     .doc = "The curve through or along the points.",
     .fallback = "\"linear\"",
     .choices = splines},
};

constexpr size_t most_points = 1024;
constexpr int parts_of_turn = 8;

// A lathe is an open surface like its patches, and all pieces of all patches are pieces of it.
class Lathe final : public Shape {
 public:
  explicit Lathe(std::vector<Bezier> patches) : patches_(std::move(patches)) {
    for (const Bezier& patch : patches_) {
      const Bounds bounds = patch.bounds();
      bounds_.include(bounds.min);
      bounds_.include(bounds.max);
    }
    search_.emplace(patches_.size(), [this](uint32_t i) { return patches_[i].bounds(); }, bounds_);
  }

  std::optional<Intersection> intersect(const Ray& ray) const override {
    return search_->nearest(ray, [&](uint32_t i) { return patches_[i].intersect(ray); });
  }
  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    return patches_[hit.part].surface(ray, hit);
  }
  Bounds bounds() const override { return bounds_; }
  bool counts_crossings() const override { return true; }
  double thickness_margin() const override {
    double least = std::numeric_limits<double>::infinity();
    for (const Bezier& patch : patches_) least = std::min(least, patch.thickness_margin());
    return least;
  }

  void pack(records::Packer& packer) const override {
    packer.scene.lathes = true;
    for (const Bezier& patch : patches_) patch.pack_of(packer, material);
  }

 private:
  std::vector<Bezier> patches_;
  Bounds bounds_;
  std::optional<PieceSearch> search_;
};

double length_of(const CubicCurve& curve) {
  double length = 0;
  for (size_t i = 1; i < 4; ++i) length += glm::length(curve.p[i] - curve.p[i - 1]);
  return length;
}

// The least distance of the curve from the axis; below 0 where it is beyond.
double least_radius(const CubicCurve& curve) {
  double least = HUGE_VAL;
  constexpr int samples = 256;
  for (int i = 0; i <= samples; ++i) least = std::min(least, curve.at(double(i) / samples).x);
  return least;
}

// The patch that the curve sweeps from angle `from` to `to`.
BezierNet swept(const CubicCurve& curve, double from, double to) {
  const double reach = 4.0 / 3 * std::tan((to - from) / 4);
  const auto direction = [](double angle) { return Vec2(std::cos(angle), -std::sin(angle)); };
  const auto along = [](double angle) { return Vec2(-std::sin(angle), -std::cos(angle)); };
  const std::array<Vec2, 4> arc = {direction(from), direction(from) + reach * along(from),
                                   direction(to) - reach * along(to), direction(to)};
  BezierNet net;
  for (size_t row = 0; row < 4; ++row)
    for (size_t column = 0; column < 4; ++column)
      net[4 * row + column] = {curve.p[row].x * arc[column].x, curve.p[row].y,
                               curve.p[row].x * arc[column].y};
  return net;
}

// The segments of the curve, without those that are points or on the axis. Empty after an error.
std::vector<CubicCurve> read_curves(TableReader& table) {
  const auto rows = table.rows("points");
  if (table.failed()) return {};
  const SplineKind& kind = *find_spline(splines[size_t(table.choice("spline"))]);
  const auto fail = [&](std::string message) {
    table.error("points", std::move(message));
    return std::vector<CubicCurve>();
  };
  if (rows.size() > most_points)
    return fail(fmt::format("a lathe has at most {} points, not {}", most_points, rows.size()));
  if (rows.size() < kind.least || (kind.step > 1 && rows.size() % kind.step != 0))
    return fail(fmt::format("a {} spline needs {} points{}, not {}", kind.name, kind.least,
                            kind.step > 1 ? " for each segment" : " or more", rows.size()));
  std::vector<Vec4> points;
  double size = 0;
  for (const std::vector<double>& row : rows) {
    points.emplace_back(row[0], row[1], 0, 0);
    size = std::max({size, std::fabs(row[0]), std::fabs(row[1] - rows[0][1])});
  }
  std::vector<CubicCurve> curves;
  for (CubicCurve& curve : spline_curves(kind, points)) {
    const double length = length_of(curve);
    double widest = 0;
    for (Vec4& p : curve.p) {
      if (std::fabs(p.x) <= 1e-12 * size) p.x = 0;
      widest = std::max(widest, std::fabs(p.x));
    }
    if (!(length > 1e-9 * size) || widest == 0) continue;
    if (least_radius(curve) < -1e-9 * size)
      return fail(
          fmt::format("the curve crosses the axis: the distance from it must not fall below 0, also "
                      "between the points of a {} spline",
                      kind.name));
    if (widest < least_bezier_thickness * length)
      return fail("the lathe is too thin to be computed with (a radius below 1e-5 of a segment's length)");
    curves.push_back(curve);
  }
  if (curves.empty()) return fail("the lathe has no surface: its curve is a point, or lies on the axis");
  return curves;
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const std::vector<CubicCurve> curves = read_curves(table);
  if (table.failed()) return nullptr;
  double whole = 0;
  for (const CubicCurve& curve : curves) whole += length_of(curve);
  const Affine map(transform);
  std::vector<Bezier> patches;
  patches.reserve(curves.size() * parts_of_turn);
  double before = 0;
  for (const CubicCurve& curve : curves) {
    const double after = before + length_of(curve);
    for (int part = 0; part < parts_of_turn; ++part) {
      const auto angle = [](int i) { return std::numbers::pi * (2.0 * i / parts_of_turn - 1); };
      BezierNet net = swept(curve, angle(part), angle(part + 1));
      for (Vec3& p : net) {
        p = map.point(p);
        if (magnitude(p) <= max_coordinate) continue;
        table.error("transform", "the transformed lathe is out of range (coordinates up to 1e12)");
        return nullptr;
      }
      if (!(thickness(net) >= least_bezier_thickness)) {
        table.error("transform",
                    "the lathe is too thin to be computed with: its points, or the transform, "
                    "leave it without area");
        return nullptr;
      }
      patches.emplace_back(net, map.mirrors(),
                           BezierRange{{double(part) / parts_of_turn, before / whole},
                                       {double(part + 1) / parts_of_turn, after / whole}});
    }
    before = after;
  }
  return std::make_unique<Lathe>(std::move(patches));
}

}  // namespace

extern const ShapeType lathe_type{.name = "lathe", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::shapes
