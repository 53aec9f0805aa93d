#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/records/records.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points within `radius` of the line segment between `from` and `to`: a cylinder that ends in two half
balls. Closed; the normals point outward.

```toml
[[capsule]]
from = [0, 0.5, 0]
to = [0, 1.5, 0]
radius = 0.5
material = "wall"
```

`transform` may be any invertible affine map. It may make the capsule elliptic and oblique.

**uv.** u runs from 0 to 1 about the axis, counter-clockwise seen from `to`. u = ½ is towards the world's +x,
or towards +z where the axis is parallel to +x. v runs from 0 at the pole below `from` to 1 at the pole beyond
`to`, in proportion to the length along the surface. A texture is therefore stretched equally on the side and
where the half balls begin.

**Numeric trap.** A cylinder and two balls that are tested separately show cracks and inner walls where they
meet. Here the ray enters once and leaves once. Where it hits the infinite cylinder beyond an end, the ball at
that end counts instead.

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
     .doc = "Distance of the surface from the axis.",
     .min = min_radius,
     .max = max_coordinate},
};

// Least ratio of length and radius, and of radius and length.
constexpr double least_ratio = 1e-6;

// All points within 1 of the y axis between −half and half.
class Capsule final : public ObjectShape {
 public:
  Capsule(const Mat4& to_world, double half)
      : ObjectShape(shader::KIND_capsule, to_world, {float(half)}), half_(half) {}

  Bounds bounds() const override {
    const Mat3 rows = glm::transpose(to_world().linear);
    const Vec3 reach(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    Bounds bounds;
    for (const double end : {-half_, half_}) {
      const Vec3 center = to_world().point({0, end, 0});
      bounds.include(center - reach);
      bounds.include(center + reach);
    }
    return bounds;
  }

  bool is_closed() const override { return true; }
  ShapeForm form() const override { return CapsuleForm{to_world().matrix(), half_}; }

 private:
  // Tests each part by itself, where it is the outermost.
  Crossings crossings(const Ray& ray) const override {
    const Vec3 &o = ray.o, &d = ray.d;
    Crossings all;
    for (const double t :
         quadratic_roots(d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z, o.x * o.x + o.z * o.z - 1))
      if (std::fabs(o.y + t * d.y) <= half_) all.add({t, 0, 0});
    for (const double side : {-1.0, 1.0}) {
      const Vec3 from_end = o - Vec3(0, side * half_, 0);
      for (const double t :
           quadratic_roots(glm::dot(d, d), glm::dot(from_end, d), glm::dot(from_end, from_end) - 1))
        if (side * (o.y + t * d.y) > half_) all.add({t, 0, 0});
    }
    return all;
  }

  Point point(const Vec3& near, const Intersection&) const override {
    const double y = std::clamp(near.y, -half_, half_);
    const Vec3 n = unit(near - Vec3(0, y, 0));
    const double u = 0.5 + std::atan2(-n.z, n.x) / (2 * std::numbers::pi);
    const double way = std::atan2(std::hypot(n.x, n.z), -n.y) + y + half_;
    const double whole = std::numbers::pi + 2 * half_;
    return {n + Vec3(0, y, 0),
            n,
            {u < 1 ? u : 0, way / whole},
            along_turn(n),
            along_meridian(n) * (whole / std::numbers::pi)};
  }

  Bounds extent() const override { return {{-1, -half_ - 1, -1}, {1, half_ + 1, 1}}; }

  double half_;
};

double half_length(const Vec3& from, const Vec3& to, double radius) {
  return glm::length(to - from) / (2 * radius);
}

Mat4 placed(const Vec3& from, const Vec3& to, double radius) {
  const double half = half_length(from, to, radius);
  return along_axis(from, to, radius, -half, half);
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 from = table.vec3("from");
  const Vec3 to = table.vec3("to");
  const double radius = table.number("radius");
  if (table.failed()) return nullptr;
  const double length = glm::length(to - from);
  if (!(length >= least_ratio * radius)) {
    table.error("to", "the axis has no length: use [[sphere]]");
  } else if (radius < least_ratio * length) {
    table.error("radius", "the capsule is too thin to be computed with (radius below 1e-6 of the length)");
  } else {
    out_of_range(table, transform * placed(from, to, radius));
  }
  if (table.failed()) return nullptr;
  return make_capsule(from, to, radius, transform);
}

}  // namespace

extern const ShapeType capsule_type{.name = "capsule", .manual = manual, .keys = keys, .parse = parse};

bool fits_capsule(const Vec3& from, const Vec3& to, double radius, const Mat4& transform) {
  const double length = glm::length(to - from);
  return length >= least_ratio * radius && radius >= least_ratio * length &&
         why_out_of_range(transform * placed(from, to, radius)).empty();
}

std::unique_ptr<Shape> make_capsule(const Vec3& from, const Vec3& to, double radius, const Mat4& transform) {
  return std::make_unique<Capsule>(transform * placed(from, to, radius), half_length(from, to, radius));
}

}  // namespace eyeray::engine::shapes
