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

// SUPERELLIPSOID_STEPS of superellipsoid.glsl.
constexpr size_t steps = 64;

constexpr std::string_view manual =
    R"(A box with rounded edges, a ball, a cylinder, a pillow, two cones, an octahedron, and all shapes between them:
(|x|^(2/e) + |z|^(2/e))^(e/n) + |y|^(2/n) = 1, measured from `center` in units of `radii`. `e` is the
roundness about the y axis, `n` that from pole to pole: 0.1 is nearly square, 1 is round, and 2 is a straight
bevel. Closed; the normals point outward.

```toml
[[superellipsoid]]
center = [0, 1, 0]
radii = [1, 1, 1]
e = 0.3
n = 0.3
material = "wall"
```

`transform` may be any invertible affine map. The shape is always convex. Exponents above 2 are refused,
because they would make it hollow and spiked.

**uv.** As on an [ellipsoid](#ellipsoid). u runs from 0 to 1 about the y axis, with ½ towards +x. v runs from
0 at the bottom to 1 at the top, by the angle seen from the centre.

**Numeric trap.** |x|^20 is 0 or infinite for most x. The shape is the unit ball of a norm, ‖‖x, z‖, y‖. That
norm is computed instead, with the largest coordinate factored out. It is convex along a ray. So Newton's
method finds the entry from outside and the exit from beyond, each without a bracket.

**Source.** Barr: Superquadrics and Angle-Preserving Transformations, IEEE CG&A 1(1), 1981.
)";

constexpr Key keys[] = {
    center_key,
    radii_key,
    {.name = "e",
     .type = KeyType::number,
     .doc = "Exponent about the y axis.",
     .fallback = "1",
     .min = 0.1,
     .max = 2},
    {.name = "n",
     .type = KeyType::number,
     .doc = "Exponent from pole to pole.",
     .fallback = "1",
     .min = 0.1,
     .max = 2},
};

class Superellipsoid final : public ObjectShape {
 public:
  // The powers of Barr's equation are p = 2/e and q = 2/n.
  Superellipsoid(const Mat4& to_world, double p, double q)
      : ObjectShape(shader::KIND_superellipsoid, to_world, {float(p), float(q)}, steps), p_(p), q_(q) {}

  bool is_closed() const override { return true; }
  ShapeForm form() const override { return SuperellipsoidForm{to_world().matrix(), 2 / p_, 2 / q_}; }

 private:
  struct Sample {
    double s, value, slope;
  };

  double norm(const Vec3& at) const {
    const double around = std::pow(std::fabs(at.x), p_) + std::pow(std::fabs(at.z), p_);
    return std::pow(std::pow(around, q_ / p_) + std::pow(std::fabs(at.y), q_), 1 / q_);
  }

  // The gradient of the norm, by differentiating Barr's equation.
  Vec3 gradient(const Vec3& at) const {
    const double around = std::pow(std::fabs(at.x), p_) + std::pow(std::fabs(at.z), p_);
    const double shared = around > 0 ? std::pow(around, q_ / p_ - 1) : 0;
    const auto derivative = [](double x, double power) {
      return std::copysign(std::pow(std::fabs(x), power - 1), x);
    };
    const Vec3 of_sum(shared * derivative(at.x, p_), derivative(at.y, q_), shared * derivative(at.z, p_));
    return of_sum * std::pow(norm(at), 1 - q_);
  }

  Sample sample(const Ray& ray, double s) const {
    const Vec3 at = ray.o + ray.d * s;
    return {s, norm(at) - 1, glm::dot(gradient(at), ray.d)};
  }

  // Finds a point within the shape by cutting planes: the tangents at two points on either side of the
  // minimum bound it from below.
  std::optional<double> inner(const Ray& ray, Sample low, Sample high) const {
    for (int i = 0; i < 400; ++i) {
      if (low.value < 0) return low.s;
      if (high.value < 0) return high.s;
      if (low.slope >= 0 || high.slope <= 0) return std::nullopt;
      const double fall = high.value - low.value - low.slope * (high.s - low.s);
      const double meeting = high.s - fall / (high.slope - low.slope);
      if (low.value + low.slope * (meeting - low.s) > 0) return std::nullopt;
      const double width = high.s - low.s;
      const double next = std::clamp(meeting, low.s + 0.1 * width, high.s - 0.1 * width);
      if (!(next > low.s && next < high.s)) return std::nullopt;
      const Sample middle = sample(ray, next);
      (middle.slope < 0 ? low : high) = middle;
    }
    // By now `low` and `high` are as near as can be: 0.9⁴⁰⁰ is 5e-19.
    return std::nullopt;
  }

  double boundary(const Ray& ray, double inside, double outside) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (norm(ray.o + ray.d * middle) < 1 ? inside : outside) = middle;
    }
    return 0.5 * (inside + outside);
  }

  Crossings crossings(const Ray& ray) const override {
    Crossings both;
    const double speed = glm::length(ray.d);
    const Ray unit_ray{ray.o, ray.d / speed};
    const double room = 3.01 - glm::dot(ray.o, ray.o);
    if (room <= 0) return both;
    const double half = std::sqrt(room);
    const auto middle = inner(unit_ray, sample(unit_ray, -half), sample(unit_ray, half));
    if (!middle) return both;
    both.add({boundary(unit_ray, *middle, -half) / speed, 0, 0});
    both.add({boundary(unit_ray, *middle, half) / speed, 0, 0});
    return both;
  }

  Point point(const Vec3& near, const Intersection&) const override {
    const Vec3 p = near / norm(near);
    const double u = 0.5 + std::atan2(-p.z, p.x) / (2 * std::numbers::pi);
    const double v = std::atan2(std::hypot(p.x, p.z), -p.y) / std::numbers::pi;
    // A derivative runs along the sphere of directions, plus as far outward or inward as keeps it on the
    // surface.
    const Vec3 g = gradient(p);
    const auto along = [&](const Vec3& d) { return d - p * (glm::dot(g, d) / glm::dot(g, p)); };
    return {p, g, {u < 1 ? u : 0, v}, along(along_turn(p)), along(along_meridian(unit(p)) * glm::length(p))};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }

  double p_, q_;
};

Mat4 placed(const Vec3& center, const Vec3& radii) {
  return {{radii.x, 0, 0, 0}, {0, radii.y, 0, 0}, {0, 0, radii.z, 0}, {center, 1}};
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 center = table.vec3("center");
  const Vec3 radii = table.vec3("radii");
  const double e = table.number("e");
  const double n = table.number("n");
  if (table.failed() || out_of_range(table, transform * placed(center, radii))) return nullptr;
  return make_superellipsoid(center, radii, e, n, transform);
}

}  // namespace

extern const ShapeType superellipsoid_type{
    .name = "superellipsoid", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_superellipsoid(const Vec3& center, const Vec3& radii, double e, double n,
                                           const Mat4& transform) {
  return std::make_unique<Superellipsoid>(transform * placed(center, radii), 2 / e, 2 / n);
}

}  // namespace eyeray::engine::shapes
