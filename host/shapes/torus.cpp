#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/records/records.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

// float32 cannot distinguish thinner tori from a circle.
constexpr double least_ratio = 1e-4;
// TORUS_CUBIC_STEPS and TORUS_STEPS of torus.glsl.
constexpr size_t steps = 24 + 48;

constexpr std::string_view manual =
    R"(All points at the distance `minor_radius` from the circle of `major_radius` about `center`, perpendicular to
`axis`: (√(x² + z²) − R)² + y² = r². Closed; the normals point out of the tube.

```toml
[[torus]]
center = [0, 0.4, 0]
axis = [0, 1, 0]
major_radius = 1
minor_radius = 0.4
material = "wall"
```

`minor_radius` must be below `major_radius`; otherwise the surface crosses itself, and has no outside. It must
be at least 1e-4 of `major_radius`. `transform` may be any invertible affine map.

**uv.** u runs from 0 to 1 about the axis, counter-clockwise seen from its tip. u = ½ is towards the world's
+x, or towards +z where the axis is parallel to +x. v runs around the tube: ½ on the outer rim, ¾ on top, 0 at
the hole.

**Numeric trap.** A ray may hit the torus four times. The closed form of the quartic equation loses or invents
roots in float32, and many of them from a distance. So a ray is first followed to its point nearest to the
centre. The roots of the derivative, which come from its own derivative in turn, are the turning points of the
quartic. Between two turning points it has at most one root, which a change of sign shows. Newton's method
with bisection finds it on the distance from the circle, which does not cancel.

**Source.** Yuksel: High-Performance Polynomial Root Finding for Graphics, HPG 2022.
)";

constexpr Key keys[] = {
    {.name = "center",
     .type = KeyType::vec3,
     .doc = "Centre of the hole.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "axis",
     .type = KeyType::vec3,
     .doc = "Direction perpendicular to the ring, of any length but 0.",
     .fallback = "[0, 1, 0]"},
    {.name = "major_radius",
     .type = KeyType::number,
     .doc = "Radius of the circle in the middle of the tube.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "minor_radius",
     .type = KeyType::number,
     .doc = "Radius of the tube; below `major_radius`.",
     .min = min_radius,
     .max = max_coordinate},
};

// The torus about the circle x² + z² = 1, y = 0.
class Torus final : public ObjectShape {
 public:
  Torus(const Mat4& to_world, double minor)
      : ObjectShape(shader::KIND_torus, to_world, {float(minor)}, steps), minor_(minor) {}

  bool is_closed() const override { return true; }
  ShapeForm form() const override { return TorusForm{to_world().matrix(), minor_}; }

 private:
  // |p|² + 1 − minor² − 2ρ on a ray of unit speed, ρ = √(x² + z²): below 0 inside. Both |p|² and ρ are
  // convex, so that their rise grows along the ray.
  struct Sample {
    double s;
    double depth;
    double square_rise;  // square rise of |p|²
    double round_rise;   // round rise of 2ρ
  };
  Sample sample(const Ray& ray, double s) const {
    const Vec3 p = ray.o + ray.d * s;
    const double round = std::sqrt(p.x * p.x + p.z * p.z);
    const double rise = round > 0 ? (p.x * ray.d.x + p.z * ray.d.z) / round : 0;
    return {s, (round - 1) * (round - 1) + p.y * p.y - minor_ * minor_, 2 * glm::dot(p, ray.d), 2 * rise};
  }

  // Adds the roots between two samples: halves the stretch until bounds of the rise prove that there is none
  // or one.
  void isolate(const Ray& ray, Sample low, Sample high, std::vector<double>& roots) const {
    const double least = low.square_rise - high.round_rise;
    const double greatest = high.square_rise - low.round_rise;
    const double width = high.s - low.s;
    const bool changes = (low.depth < 0) != (high.depth < 0);
    const double fall = std::max({-least, greatest, 0.0}) * width;
    if (!changes && std::fabs(low.depth) + std::fabs(high.depth) > fall) return;
    if (least > 0 || greatest < 0 || width < 1e-14) {
      if (changes) roots.push_back(bisect(ray, low, high));
      return;
    }
    const Sample middle = sample(ray, 0.5 * (low.s + high.s));
    isolate(ray, low, middle, roots);
    isolate(ray, middle, high, roots);
  }

  double bisect(const Ray& ray, const Sample& low, const Sample& high) const {
    double same = low.s, other = high.s;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (same + other);
      ((sample(ray, middle).depth < 0) == (low.depth < 0) ? same : other) = middle;
    }
    return 0.5 * (same + other);
  }

  Crossings crossings(const Ray& ray) const override {
    const double speed = glm::length(ray.d);
    const Ray unit_ray{ray.o, ray.d / speed};
    const double reach = 1.01 * (1 + minor_);
    const double room = reach * reach - glm::dot(ray.o, ray.o);
    Crossings all;
    if (room <= 0) return all;
    std::vector<double> roots;
    isolate(unit_ray, sample(unit_ray, -std::sqrt(room)), sample(unit_ray, std::sqrt(room)), roots);
    for (size_t i = 0; i < std::min<size_t>(roots.size(), 4); ++i) all.add({roots[i] / speed, 0, 0});
    return all;
  }

  Point point(const Vec3& near, const Intersection&) const override {
    const double round = std::hypot(near.x, near.z);
    const double u_angle = std::atan2(-near.z, near.x);
    const double v_angle = std::atan2(near.y, round - 1);
    const Vec3 outward = round > 0 ? Vec3(near.x, 0, near.z) / round : Vec3(1, 0, 0);
    const Vec3 gradient = outward * std::cos(v_angle) + Vec3(0, std::sin(v_angle), 0);
    const auto turns = [](double angle) {
      const double share = 0.5 + angle / (2 * std::numbers::pi);
      return share < 1 ? share : 0;
    };
    const Vec3 p = outward + gradient * minor_;
    return {p,
            gradient,
            {turns(u_angle), turns(v_angle)},
            along_turn(p),
            2 * M_PI * minor_ * (Vec3(0, std::cos(v_angle), 0) - outward * std::sin(v_angle))};
  }

  Bounds extent() const override {
    const double widest = 1 + minor_;
    return {{-widest, -minor_, -widest}, {widest, minor_, widest}};
  }

  double minor_;
};

Mat4 placed(const Vec3& center, const Vec3& axis, double major_radius) {
  return along_axis(center, center + unit(axis) * major_radius, major_radius, 0, 1);
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 center = table.vec3("center");
  const Vec3 axis = table.vec3("axis");
  const double major_radius = table.number("major_radius");
  const double minor_radius = table.number("minor_radius");
  if (table.failed()) return nullptr;
  if (axis == Vec3(0)) {
    table.error("axis", "the axis has no length");
  } else if (minor_radius >= major_radius) {
    table.error("minor_radius", "the torus crosses itself: minor_radius must be below major_radius");
  } else if (minor_radius < least_ratio * major_radius) {
    table.error("minor_radius", "the torus is too thin: minor_radius must be at least 1e-4 of major_radius");
  } else {
    out_of_range(table, transform * placed(center, axis, major_radius));
  }
  if (table.failed()) return nullptr;
  return make_torus(center, axis, major_radius, minor_radius, transform);
}

}  // namespace

extern const ShapeType torus_type{.name = "torus", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_torus(const Vec3& center, const Vec3& axis, double major_radius,
                                  double minor_radius, const Mat4& transform) {
  return std::make_unique<Torus>(transform * placed(center, axis, major_radius), minor_radius / major_radius);
}

}  // namespace eyeray::engine::shapes
