#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <span>

#include "host/formula/formula.hpp"
#include "host/reading/formula_reader.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/spline.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All balls whose centres are on a curve, as POV-Ray's sphere_sweep: a rope, a horn, an arm of an octopus. The radius
varies along the curve. Each of `points` is a centre and a radius, [x, y, z, radius], and `spline` is the curve through
or near these points:

| `spline` | curve | points |
| --- | --- | --- |
| `"linear"` | straight pieces from point to point | 2 or more |
| `"cubic"` | Catmull and Rom's: through all points but the first and the last, which set the direction at the ends | 4 or more |
| `"b_spline"` | a uniform cubic B-spline: smoother, near the points but not through them | 4 or more |
| `"bezier"` | cubic Bézier curves, of four points each | 4, 8, 12, … |

```toml
[[sphere_sweep]]
points = [
  [1.2, 0.3, 0, 0.3], [1.2, 0.3, 0, 0.3], [0, 0.3, 1.2, 0.25], [-1.2, 0.6, 0, 0.2],
  [0, 1, -0.9, 0.12], [0.5, 1.4, 0, 0.02], [0.5, 1.4, 0, 0.02],
]
spline = "cubic"
material = "wall"
```

The ends are round. Closed; the normal points outward. The sweep may cross itself, and may be of glass: it is one body,
without surfaces inside. Where a spline takes the radius below 0, there is no ball. `transform` may be any invertible
affine map.

A sweep consists of at most 32 pieces. A piece is a segment of the curve, or a part of one that bends little. A segment
that turns by less than 69° is one piece, unless its balls are large for the bend. [Capsules](#capsule) are faster than
a linear sweep, but each is its own body.

**The distance.** The surface is an [implicit](#implicit) one: its function is the distance from the nearest ball. A
piece has one local minimum of it at most. There, it is estimated by the cone that touches the curve's balls, and the
least estimate leads to the exact minimum by Newton's method. For straight segments the estimate is exact. Near the
centre of a tight bend a piece may have two minima, and one is missed. The distance is then too large by up to a tenth,
so the `lipschitz` constant is 1.1. A ball whose radius is that of its bend may be off there by a few thousandths of the
sweep's size.

**uv, numeric trap.** As for an [implicit](#implicit) surface with a `lipschitz` constant. Radii below 1e-5 of the
sweep's size may be missed.

**Source.** POV-Ray 3.7, reference, section 3.4.5.1.13 (Sphere Sweep).
)";

constexpr std::string_view columns[] = {"x", "y", "z", "radius"};
constexpr std::string_view splines[] = {"linear", "cubic", "b_spline", "bezier"};

constexpr Key keys[] = {
    {.name = "points",
     .type = KeyType::rows,
     .doc = "Points of the curve: centre and radius of a ball.",
     .min = -max_coordinate,
     .max = max_coordinate,
     .choices = columns},
    {.name = "spline",
     .type = KeyType::choice,
     .doc = "The curve through or near the points.",
     .fallback = "\"linear\"",
     .choices = splines},
};

constexpr size_t most_pieces = 32;
constexpr size_t group = 4;               // pieces in a row that are skipped together
constexpr double least_thickness = 1e-5;  // the largest radius, over half the size

// A piece turns at most this far, less far if its balls are large for the bend, and its speed changes at most
// by this factor. Then it has one local minimum of the distance at most, except from near the centre of its
// bend.
constexpr double most_turn = 1.2;
constexpr double most_thick_turn = 0.5;
constexpr double most_speedup = 2;
constexpr int most_halvings = 5;

// If a local minimum is missed, the distance is too large by less than this factor.
constexpr double steepest = 1.1;

bool bends_much(const CubicCurve& curve) {
  double turn = 0, length = 0, shortest = HUGE_VAL, longest = 0, radius = curve.p[0].w;
  Vec3 before(0);
  for (size_t i = 1; i < 4; ++i) {
    const Vec3 leg = curve.p[i] - curve.p[i - 1];
    const double leg_length = glm::length(leg);
    length += leg_length;
    shortest = std::min(shortest, leg_length);
    longest = std::max(longest, leg_length);
    radius = std::max(radius, curve.p[i].w);
    if (leg_length == 0) continue;
    if (before != Vec3(0)) turn += std::acos(glm::clamp(glm::dot(before, leg) / leg_length, -1.0, 1.0));
    before = leg / leg_length;
  }
  const bool is_thick = radius * turn > 0.5 * length;
  return turn > (is_thick ? most_thick_turn : most_turn) || longest > most_speedup * shortest;
}

// Appends the curve in pieces that bend little.
void split(const CubicCurve& curve, int halvings, std::vector<CubicCurve>& pieces) {
  if (halvings == 0 || !bends_much(curve)) return pieces.push_back(curve);
  split(curve.part(0, 0.5), halvings - 1, pieces);
  split(curve.part(0.5, 1), halvings - 1, pieces);
}

// The box of a curve's balls: of those of its parts, each within the hull of its control points.
Bounds bounds_of(const CubicCurve& curve) {
  constexpr int parts = 32;
  Bounds box{Vec3(HUGE_VAL), Vec3(-HUGE_VAL)};
  for (int i = 0; i < parts; ++i) {
    const CubicCurve part = curve.part(double(i) / parts, double(i + 1) / parts);
    double radius = part.p[0].w;
    for (const Vec4& p : part.p) radius = std::max(radius, p.w);
    if (radius < 0) continue;
    for (const Vec4& p : part.p) {
      box.include(Vec3(p) - radius);
      box.include(Vec3(p) + radius);
    }
  }
  return box;
}

// A ball that holds the balls of all these curves, and some room for rounding.
Vec4 ball_around(std::span<const CubicCurve> curves) {
  Vec3 low(HUGE_VAL), high(-HUGE_VAL);
  for (const CubicCurve& curve : curves)
    for (const Vec4& p : curve.p) {
      low = glm::min(low, Vec3(p));
      high = glm::max(high, Vec3(p));
    }
  const Vec3 center = 0.5 * (low + high);
  double radius = -HUGE_VAL;
  for (const CubicCurve& curve : curves)
    for (const Vec4& p : curve.p) radius = std::max(radius, glm::length(Vec3(p) - center) + p.w);
  return {center, radius + 1e-5};
}

// `nearest` finds the piece with the least distance, and t there. `refine` takes one of Newton's steps, or
// halves the range of t, which is t.y to t.z.
constexpr std::string_view functions = R"glsl(
float change(vec3 v, float length_of_v, vec4 slope) { return -dot(v, slope.xyz) - length_of_v * slope.w; }
void refine(vec3 p, vec4 a, vec4 b, vec4 c, vec4 d, inout vec3 t) {
  vec4 slope = b + t.x * (2.0 * c + t.x * (3.0 * d));
  vec3 v = p - (a + t.x * (b + t.x * (c + t.x * d))).xyz;
  float u = length(v);
  float x = change(v, u, slope);
  float bend = change(v, u, 2.0 * c + 6.0 * t.x * d);
  float rate = dot(slope.xyz, slope.xyz) + bend + slope.w * dot(v, slope.xyz) / max(u, 1.0e-20);
  t = x < 0.0 ? vec3(t.x, t.x, t.z) : vec3(t.x, t.y, t.x);
  float next = t.x - x / rate;
  t.x = rate > 0.0 && next >= t.y && next <= t.z ? next : 0.5 * (t.y + t.z);
}
vec4 nearest(vec3 p) {
  vec3 v;
  float u;
  float least = 1.0e30;
  vec3 t = vec3(0.0, 0.0, 1.0);
  vec4 a = vec4(0.0), b = vec4(0.0), c = vec4(0.0), d = vec4(0.0);
)glsl";
constexpr std::string_view entries = R"glsl(
  return vec4(p, 0.0) - (a + t.x * (b + t.x * (c + t.x * d)));
}
float f(vec3 p) {
  vec4 v = nearest(p);
  return length(v.xyz) + v.w;
}
vec3 gradient(vec3 p) {
  vec3 v = nearest(p).xyz;
  return v / max(length(v), 1.0e-20);
}
)glsl";
constexpr int refinements = 3;

// Writes the formula. Piece i has the balls aI + t·(bI + t·(cI + t·dI)), with t from 0 to 1: a centre and a
// radius. The distance changes by x at its start and by y at its end, times a positive number. The text has
// no arrays and no loops: drivers take minutes to compile arrays in loops, and may end long loops early.
class FormulaWriter {
 public:
  explicit FormulaWriter(const std::vector<CubicCurve>& pieces) : pieces_(pieces) {}

  std::string run() {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const CubicCurve& piece = pieces_[i];
      add("const vec4 a{0} = {1};\nconst vec4 b{0} = {2};\n", i, text_of(piece.p[0]),
          text_of(piece.derivative(0)));
      if (!is_straight(i))
        add("const vec4 c{0} = {1};\nconst vec4 d{0} = {2};\n", i, text_of(square(i)), text_of(cube(i)));
    }
    text_ += functions;
    for (size_t i = 0; i < pieces_.size(); i += group) write_group(i, std::min(i + group, pieces_.size()));
    bool bent = false;
    for (size_t i = 0; i < pieces_.size(); ++i) bent = bent || !is_straight(i);
    for (int i = 0; i < refinements && bent; ++i) text_ += "  refine(p, a, b, c, d, t);\n";
    text_ += entries;
    return std::move(text_);
  }

 private:
  template <typename... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...);
  }
  static std::string text_of(const Vec4& v) {
    return fmt::format("vec4({:#.9g}, {:#.9g}, {:#.9g}, {:#.9g})", v.x, v.y, v.z, v.w);
  }
  Vec4 square(size_t i) const {
    const std::array<Vec4, 4>& p = pieces_[i].p;
    return 3.0 * (p[0] - 2.0 * p[1] + p[2]);
  }
  Vec4 cube(size_t i) const {
    const std::array<Vec4, 4>& p = pieces_[i].p;
    return p[3] - p[0] + 3.0 * (p[1] - p[2]);
  }
  bool is_straight(size_t i) const { return glm::length(square(i)) + glm::length(cube(i)) < 1e-12; }
  // The slope at the piece's end over that at the start of the next; 0 if they have other directions.
  double ratio(size_t i) const {
    if (i + 1 == pieces_.size()) return 0;
    const Vec4 end = pieces_[i].derivative(1), start = pieces_[i + 1].derivative(0);
    const double ratio = glm::length(end) / glm::length(start);
    return glm::length(end - ratio * start) < 1e-9 * glm::length(end) ? ratio : 0;
  }

  // The pieces from `first` to before `end`, if a ball of them may be nearer than those before.
  void write_group(size_t first, size_t end) {
    const Vec4 around = ball_around(std::span(pieces_).subspan(first, end - first));
    add("  if (distance(p, {}.xyz) - {:#.9g} < least) {{\n", text_of(around), around.w);
    write_start(first);
    if (first == 0) write_joint("-x0", pieces_[0].p[0].w, 0, 0);
    for (size_t i = first; i < end; ++i) {
      const double radius = pieces_[i].p[3].w;
      if (i + 1 < pieces_.size())
        write_start(i + 1);
      else
        add("    v = p - {}.xyz;\n    u = length(v);\n", text_of(pieces_[i].p[3]));

      // The change at both sides of a smooth joint has the same sign, also if rounded: so it cannot be missed
      // between them.
      if (const double next = ratio(i); next > 0)
        add("    float y{} = {:#.9g} * x{};\n", i, next, i + 1);
      else
        add("    float y{} = change(v, u, {});\n", i, text_of(pieces_[i].derivative(1)));
      if (i + 1 == pieces_.size())
        write_joint(fmt::format("y{}", i), radius, i, 1);
      else if (ratio(i) == 0)
        write_joint(fmt::format("max(y{}, -x{})", i, i + 1), radius, i + 1, 0);
      write_piece(i);
    }
    text_ += "  }\n";
  }
  void write_start(size_t i) {
    add("    v = p - a{0}.xyz;\n    u = length(v);\n    float x{0} = change(v, u, b{0});\n", i);
  }
  // A ball at the end of a piece is a local minimum if `above`, an expression, is not above 0. Piece i has it
  // at t.
  void write_joint(const std::string& above, double radius, size_t i, int t) {
    add("    if (max({}, u - {:#.9g} - least) <= 0.0) {{\n      least = u - {:#.9g};\n", above, radius,
        radius);
    write_choice(i, fmt::format("{}.0", t));
  }
  void write_choice(size_t i, const std::string& t) {
    const bool straight = is_straight(i);
    add("      t.x = {0};\n      a = a{1};\n      b = b{1};\n      c = {2};\n      d = {3};\n    }}\n", t, i,
        straight ? "vec4(0.0)" : fmt::format("c{}", i), straight ? "vec4(0.0)" : fmt::format("d{}", i));
  }
  // The local minimum within the piece, if it has one: the distance from a cone that touches balls around it.
  void write_piece(size_t i) {
    add("    if (max(x{0}, -y{0}) <= 0.0) {{\n", i);
    if (is_straight(i))
      add("      float s = 0.0;\n      vec4 at = a{0};\n      vec4 slope = b{0};\n", i);
    else
      add("      float s = x{0} / min(x{0} - y{0}, -1.0e-20);\n      vec4 at = a{0} + s * (b{0} + s * (c{0} "
          "+ s * d{0}));\n"
          "      vec4 slope = b{0} + s * (2.0 * c{0} + s * (3.0 * d{0}));\n",
          i);
    text_ += R"glsl(
      v = p - at.xyz;
      float square = max(dot(slope.xyz, slope.xyz), 1.0e-20);
      float ahead = dot(v, slope.xyz) / square;
      float across = sqrt(max(dot(v, v) - ahead * ahead * square, 0.0));
      float narrows = sqrt(max(1.0 - slope.w * slope.w / square, 1.0e-6));
      u = across * narrows - slope.w * ahead - at.w;
      s = clamp(s + ahead + slope.w * across / (narrows * square), 0.0, 1.0);
)glsl";
    add("      if (u < least) {{\n      least = u;\n");
    write_choice(i, "s");
    text_ += "    }\n";
  }

  const std::vector<CubicCurve>& pieces_;
  std::string text_;
};

// The pieces of the curve. Empty after an error.
std::vector<CubicCurve> read_pieces(TableReader& table) {
  const auto rows = table.rows("points");
  if (table.failed()) return {};
  const SplineKind& kind = *find_spline(splines[size_t(table.choice("spline"))]);
  const auto fail = [&](std::string message) {
    table.error("points", std::move(message));
    return std::vector<CubicCurve>();
  };
  if (rows.size() < kind.least || (kind.step > 1 && rows.size() % kind.step != 0))
    return fail(fmt::format("a {} spline needs {} points{}, not {}", kind.name, kind.least,
                            kind.step > 1 ? " for each segment" : " or more", rows.size()));
  std::vector<Vec4> points;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][3] < 0) {
      table.error("points", "a radius must be 0 or more", {i});
      return {};
    }
    points.emplace_back(rows[i][0], rows[i][1], rows[i][2], rows[i][3]);
    if (kind.step > 1 && i > 0 && i % kind.step == 0 && points[i] != points[i - 1]) {
      table.error("points", "a segment must start at the point at which the one before it ends", {i});
      return {};
    }
  }
  std::vector<CubicCurve> pieces;
  for (const CubicCurve& curve : spline_curves(kind, points)) split(curve, most_halvings, pieces);
  if (pieces.size() > most_pieces)
    return fail(
        fmt::format("a sphere sweep has at most {} pieces, and this one has {}: use fewer points, "
                    "gentler bends, or several sweeps",
                    most_pieces, pieces.size()));
  return pieces;
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  std::vector<CubicCurve> pieces = read_pieces(table);
  if (table.failed()) return nullptr;
  Bounds around{Vec3(HUGE_VAL), Vec3(-HUGE_VAL)};
  double thickest = 0;
  for (const CubicCurve& piece : pieces) {
    const Bounds box = bounds_of(piece);
    around = {glm::min(around.min, box.min), glm::max(around.max, box.max)};
    for (int i = 0; i <= 16; ++i) thickest = std::max(thickest, piece.at(i / 16.0).w);
  }

  // The formula is in a space in which the sweep is about 2 wide.
  const Vec3 center = (around.min + around.max) * 0.5, half = (around.max - around.min) * 0.5;
  const double scale = std::max({half.x, half.y, half.z});
  if (!(thickest >= min_radius && thickest >= least_thickness * scale)) {
    table.error("points", "the sphere sweep is too thin: a radius must be at least 1e-5 of half its size");
    return nullptr;
  }
  for (CubicCurve& piece : pieces)
    for (Vec4& p : piece.p) p = (p - Vec4(center, 0)) / scale;
  const Mat4 to_world = glm::scale(glm::translate(transform, center), Vec3(scale));
  const Vec3 room = half / scale * 1.001;  // the surface must not touch the box's faces
  if (out_of_range(table, glm::scale(to_world, room))) return nullptr;
  const std::string title = reading::formula_title(table, "[[sphere_sweep]]");
  auto formula = std::make_shared<const formula::Formula>(
      formula::FormulaText{FormulaWriter(pieces).run(), {title, 0, 0}},
      std::vector<formula::FormulaParameter>{}, title);
  return make_implicit({std::move(formula), {-room, room}, steepest}, false, to_world);
}

}  // namespace

extern const ShapeType sphere_sweep_type{
    .name = "sphere_sweep", .manual = manual, .keys = keys, .parse = parse};

}  // namespace eyeray::engine::shapes
