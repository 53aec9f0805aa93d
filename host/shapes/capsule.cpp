#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/records/packer.hpp"
#include "host/shapes/capsule.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points within `radius` of the line segment between `from` and `to`: a cylinder that ends in two half
balls. With a `to_radius` the ball around `to` has that radius, and the cone that touches both balls joins them: a round
cone. If one ball contains the other, the shape is the larger ball. Closed; the normals point outward.

```toml
[[capsule]]
from = [0, 0.5, 0]
to = [0, 1.5, 0]
radius = 0.5
material = "wall"
```

```toml
[[capsule]]
from = [0, 0.5, 0]
to = [0, 1.5, 0]
radius = 0.5
to_radius = 0.2
material = "wall"
```

`transform` may be any invertible affine map. It may make the capsule elliptic and oblique.

**uv.** u runs from 0 to 1 about the axis, counter-clockwise seen from `to`. u = ½ is towards the world's +x,
or towards +z where the axis is parallel to +x. v runs from 0 at the pole below `from` to 1 at the pole beyond
`to`, in proportion to the length along the surface. A texture is therefore stretched equally on the side and
where the balls begin.

**Numeric trap.** A cylinder and two balls that are tested separately show cracks and inner walls where they
meet. Here the ray enters once and leaves once. Where it hits the infinite cylinder or cone beyond an end, the ball at
that end counts instead. A point is beyond an end if its projection onto the axis, along the side's normal, is.

**Source.** Haines, Günther, Akenine-Möller: Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, chapter 7, 2019, for its
quadratic equations.
)";

constexpr Key keys[] = {
    {.name = "from",
     .type = KeyType::vec3,
     .doc = "Start of the axis: the centre of one half ball.",
     .min = -max_coordinate,
     .max = max_coordinate},
    axis_to_key,
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the surface from the axis, or the radius of the ball around `from`.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "to_radius",
     .type = KeyType::number,
     .doc = "Radius of the ball around `to`; 0 makes a tip. When absent: `radius`.",
     .min = 0,
     .max = max_coordinate,
     .optional = true},
};

// True if one of two balls contains the other, up to a tip that float32 would hardly show.
bool is_one_ball(double length, double low, double high) {
  return !(std::fabs(low - high) < length * (1 - 1e-6));
}

// The parameters that the shaders find: only `half` of a capsule, 12 numbers of a round cone.
std::vector<float> parameters(const RoundCone& cone, const AlongV& v) {
  if (cone.low == cone.high) return {float(cone.half)};
  const double middle = (cone.low + cone.high) / 2;
  const double jump = std::acos(-cone.slope()) * (v.low_ball - v.high_ball);
  std::vector<float> all;
  for (const double value : {cone.half, cone.cosine(), cone.slope(), middle,                    //
                             cone.low, cone.high, v.low_ball / v.whole, v.high_ball / v.whole,  //
                             v.side / v.whole, jump / v.whole, 1 / v.whole, 0.0})
    all.push_back(float(value));
  return all;
}

// In proportion to the length along the surface.
AlongV along_surface(const RoundCone& cone) {
  AlongV v{.low_ball = cone.low, .high_ball = cone.high, .side = cone.cosine()};
  const double angle = std::acos(-cone.slope());
  v.whole = cone.low * angle + cone.high * (std::numbers::pi - angle) + 2 * v.side * cone.half;
  return v;
}

}  // namespace

Capsule::Capsule(const Mat4& to_world, const RoundCone& cone)
    : ObjectShape(shader::KIND_capsule, to_world, parameters(cone, along_surface(cone))),
      cone_(cone),
      slope_(cone.slope()),
      cosine_(cone.cosine()),
      middle_((cone.low + cone.high) / 2),
      v_(along_surface(cone)) {}

Bounds Capsule::bounds() const {
  const Mat3 rows = glm::transpose(to_world().linear);
  const Vec3 reach(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
  Bounds bounds;
  for (const double end : {-1.0, 1.0}) {
    const Vec3 center = to_world().point({0, end * cone_.half, 0});
    const double radius = end < 0 ? cone_.low : cone_.high;
    bounds.include(center - reach * radius);
    bounds.include(center + reach * radius);
  }
  return bounds;
}

void Capsule::pack(records::Packer& packer) const {
  packer.scene.round_cones = packer.scene.round_cones || cone_.low != cone_.high;
  ObjectShape::pack(packer);
}

double Capsule::center_below(const Vec3& p) const {
  return p.y - std::hypot(p.x, p.z) * (slope_ / cosine_);
}

// Tests each part by itself, where it is the outermost.
ObjectShape::Crossings Capsule::crossings(const Ray& ray) const {
  const Vec3 &o = ray.o, &d = ray.d;
  const double half = cone_.half, square = cosine_ * cosine_;
  const double radius = middle_ - slope_ * o.y, growth = -slope_ * d.y;
  Crossings all;
  for (const double t : quadratic_roots(square * (d.x * d.x + d.z * d.z) - growth * growth,
                                        square * (o.x * d.x + o.z * d.z) - radius * growth,
                                        square * (o.x * o.x + o.z * o.z) - radius * radius))
    if (radius + t * growth >= 0 && std::fabs(center_below(o + t * d)) <= half) all.add({t, 0, 0});
  for (const double side : {-1.0, 1.0}) {
    const Vec3 from_end = o - Vec3(0, side * half, 0);
    const double ball = side < 0 ? cone_.low : cone_.high;
    for (const double t :
         quadratic_roots(glm::dot(d, d), glm::dot(from_end, d), glm::dot(from_end, from_end) - ball * ball))
      if (side * center_below(o + t * d) > half) all.add({t, 0, 0});
  }
  return all;
}

ObjectShape::Point Capsule::point(const Vec3& near, const Intersection&) const {
  const double half = cone_.half;
  const double y = std::clamp(center_below(near), -half, half);
  const Vec3 off = near - Vec3(0, y, 0);
  const Vec3 n = off == Vec3(0) ? Vec3(1, 0, 0) : unit(off);  // the tip of a cone may be hit exactly
  const double radius = middle_ - slope_ * y;
  const Vec3 p = n * radius + Vec3(0, y, 0);
  const double u = 0.5 + std::atan2(-n.z, n.x) / (2 * std::numbers::pi);
  const double angle = std::atan2(std::hypot(n.x, n.z), -n.y);
  const bool on_low = n.y < slope_;
  const double way = angle * (on_low ? v_.low_ball : v_.high_ball) + v_.side * y + v_.side * half +
                     (on_low ? 0 : std::acos(-slope_) * (v_.low_ball - v_.high_ball));
  return {p,
          n,
          {u < 1 ? u : 0, way / v_.whole},
          along_turn(n * radius),
          along_meridian(n) * (v_.whole / std::numbers::pi)};
}

PlacedRoundCone place_round_cone(const Vec3& from, const Vec3& to, double low, double high, const Vec3& x,
                                 const Vec3& y) {
  const double radius = std::max(low, high), length = glm::length(to - from);
  const Vec3 z = glm::cross(x, y);
  PlacedRoundCone placed;
  Vec3 center = (from + to) * 0.5;
  if (is_one_ball(length, low, high))
    center = low > high ? from : to;
  else
    placed.cone = {length / (2 * radius), low / radius, high / radius};
  placed.to_world = {{x * radius, 0}, {y * radius, 0}, {z * radius, 0}, {center, 1}};
  return placed;
}

namespace {

// Least ratio of length and radius, and of radius and length.
constexpr double least_ratio = 1e-6;

PlacedRoundCone placed(const Vec3& from, const Vec3& to, double low, double high) {
  const double radius = std::max(low, high), half = glm::length(to - from) / (2 * radius);
  const Mat4 map = along_axis(from, to, radius, -half, half);
  if (low == high) return {map, {half, 1, 1}};
  return place_round_cone(from, to, low, high, unit(Vec3(map[0])), unit(Vec3(map[1])));
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 from = table.vec3("from");
  const Vec3 to = table.vec3("to");
  const double low = table.number("radius");
  if (table.failed()) return nullptr;
  const double high = table.has("to_radius") ? table.number("to_radius") : low;
  const double radius = std::max(low, high);
  const double length = glm::length(to - from);
  if (!(length >= least_ratio * radius)) {
    table.error("to", "the axis has no length: use [[sphere]]");
  } else if (radius < least_ratio * length) {
    table.error("radius", "the capsule is too thin to be computed with (radius below 1e-6 of the length)");
  } else {
    out_of_range(table, transform * placed(from, to, low, high).to_world);
  }
  if (table.failed()) return nullptr;
  return make_capsule(from, to, low, transform, high);
}

}  // namespace

extern const ShapeType capsule_type{.name = "capsule", .manual = manual, .keys = keys, .parse = parse};

bool fits_capsule(const Vec3& from, const Vec3& to, double radius, const Mat4& transform) {
  const double length = glm::length(to - from);
  return length >= least_ratio * radius && radius >= least_ratio * length &&
         why_out_of_range(transform * placed(from, to, radius, radius).to_world).empty();
}

std::unique_ptr<Shape> make_capsule(const Vec3& from, const Vec3& to, double radius, const Mat4& transform,
                                    std::optional<double> to_radius) {
  const auto [map, cone] = placed(from, to, radius, to_radius.value_or(radius));
  return std::make_unique<Capsule>(transform * map, cone);
}

}  // namespace eyeray::engine::shapes
