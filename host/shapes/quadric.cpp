#include <algorithm>
#include <cmath>

#include "host/records/records.hpp"
#include "host/shapes/cube.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(Any surface of the second degree: A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + J z + K = 0. It is
clipped by the box from `min` to `max`. The inside is where that value is below 0, within the box. The normals
point to where it grows. Closed: where the inside reaches the box, the box's faces are its caps. With
`open = true` they are left out, and the surface is a sheet.

```toml
[[quadric]]                # a saddle: y = x² − z²
square = [1, 0, -1]        # A, B, C: factors of x², y², z²
linear = [0, -1, 0]        # G, H, J: factors of x, y, z
min = [-1, -1, -1]
max = [1, 1, 1]
open = true
material = "wall"
```

A hyperboloid of two sheets is `square = [1, -1, 1]`, `constant = 0.1`. A hyperbolic cylinder is
`square = [1, 0, -1]`, `constant = 0.1`. Two planes that cross are `product = [1, 0, 0]`. If a surface has a
shape of its own here, such as an [ellipsoid](#ellipsoid) or a [cone](#cone), that shape is faster and more
exact.

`transform` may be any invertible affine map. It moves the surface and the box.

**uv.** On a cap, the uv of that [box](#box) face. Elsewhere, the uv of the box face to which the normal would
point if the box were stretched to a cube. The texture is projected straight onto that face.

**Numeric trap.** All values are computed in a space where the box is the cube from −1 to 1. Rounding is 10⁻⁷
of the largest term there, so choose the box no larger than necessary. At a point where the gradient is 0,
such as a cone's apex, f is quadratic, so its rounding corresponds to a large distance. Rays start farther
away there. The box's faces and the quadric are cut as intervals of one ray, so there is no crack between
them.

**Source.** Any textbook; the cuts after Kay and Kajiya: Ray Tracing Complex Scenes, SIGGRAPH 1986.
)";

constexpr Key keys[] = {
    {.name = "square",
     .type = KeyType::vec3,
     .doc = "Factors of x², y² and z².",
     .fallback = "[0, 0, 0]",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "product",
     .type = KeyType::vec3,
     .doc = "Factors of xy, xz and yz.",
     .fallback = "[0, 0, 0]",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "linear",
     .type = KeyType::vec3,
     .doc = "Factors of x, y and z.",
     .fallback = "[0, 0, 0]",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "constant", .type = KeyType::number, .doc = "Constant term of the equation.", .fallback = "0"},
    box_min_key,
    box_max_key,
    box_open_key,
};

// f and its derivatives.
struct Form {
  QuadricValues values;

  // 2 Q, where vᵀQv are the terms of the second degree.
  Mat3 hessian() const {
    const auto& [square, product, linear, constant] = values;
    return {{2 * square.x, product.x, product.y},
            {product.x, 2 * square.y, product.z},
            {product.y, product.z, 2 * square.z}};
  }
  double at(const Vec3& p) const {
    return glm::dot(p, hessian() * p) / 2 + glm::dot(values.linear, p) + values.constant;
  }
  Vec3 gradient(const Vec3& p) const { return hessian() * p + values.linear; }
};

// The function f in the coordinates in which the box is the cube, scaled so that its largest factor is ±1.
Form in_cube(const QuadricValues& values, const Vec3& min, const Vec3& max) {
  const Vec3 half = (max - min) * 0.5;
  const Vec3 center = min + half;
  const Form world{values};
  Form form{{values.square * half * half,
             values.product * Vec3(half.x * half.y, half.x * half.z, half.y * half.z),
             world.gradient(center) * half, world.at(center)}};
  auto& [square, product, linear, constant] = form.values;
  const double largest =
      std::max({magnitude(square), magnitude(product), magnitude(linear), std::fabs(constant)});
  if (largest > 0) {
    for (Vec3* factors : {&square, &product, &linear}) *factors /= largest;
    constant /= largest;
  }
  return form;
}

// 1 if f is surely above 0 in the whole cube, −1 if surely below, else 0. Exact for f without products.
int sign_in_cube(const Form& form) {
  const QuadricValues& f = form.values;
  const double products = std::fabs(f.product.x) + std::fabs(f.product.y) + std::fabs(f.product.z);
  double least = f.constant - products, greatest = f.constant + products;
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = [&](double x) { return (f.square[axis] * x + f.linear[axis]) * x; };
    const double vertex =
        f.square[axis] != 0 ? std::clamp(-f.linear[axis] / (2 * f.square[axis]), -1.0, 1.0) : 1;
    least += std::min({along(-1), along(1), along(vertex)});
    greatest += std::max({along(-1), along(1), along(vertex)});
  }
  return least > 0 ? 1 : greatest < 0 ? -1 : 0;
}

class Quadric final : public ObjectShape {
 public:
  Quadric(const Mat4& to_world, const Form& form, bool open)
      : ObjectShape(shader::KIND_quadric, to_world, parameters(form.values, open)),
        form_(form),
        open_(open) {}

  bool is_closed() const override { return !open_; }
  ShapeForm form() const override {
    const auto& [square, product, linear, constant] = form_.values;
    return QuadricForm{to_world().matrix(), square, product, linear, constant, extent(), open_};
  }

 private:
  static constexpr double itself = 6;  // Intersection::u, beside the cube's faces

  static std::vector<float> parameters(const QuadricValues& values, bool open) {
    const auto& [square, product, linear, constant] = values;
    return {float(square.x),  float(square.y),  float(square.z),  open ? 1.0f : 0.0f,
            float(product.x), float(product.y), float(product.z), float(constant),
            float(linear.x),  float(linear.y),  float(linear.z)};
  }

  // The quadric where it is within the cube, and the cube's faces where they are within the quadric.
  Crossings crossings(const Ray& ray) const override {
    Crossings all;
    const auto span = cube::span(ray);
    if (!span) return all;
    const Vec3 bend = form_.hessian() * ray.d;
    for (const double t : quadratic_roots(glm::dot(ray.d, bend) / 2,
                                          glm::dot(form_.gradient(ray.o), ray.d) / 2, form_.at(ray.o)))
      if (t >= span->in.t && t <= span->out.t) all.add({t, itself, 0});
    if (open_) return all;
    for (const cube::Crossing& face : {span->in, span->out})
      if (form_.at(ray.o + ray.d * face.t) <= 0) all.add({face.t, double(face.face), 0});
    return all;
  }

  Point point(const Vec3& near, const Intersection& hit) const override {
    if (hit.u != itself) {
      const int face = int(hit.u);
      const Vec3 p = cube::onto(face, near);
      const auto [along_u, along_v] = cube::along_uv(face, cube::normal(face));
      return {p, cube::normal(face), cube::uv(face, p), along_u, along_v};
    }
    // One step of Newton's along the gradient; where that is 0 there is nowhere to go.
    Vec3 gradient = form_.gradient(near);
    const double squared = glm::dot(gradient, gradient);
    const Vec3 p = squared > 1e-12 ? near - gradient * (form_.at(near) / squared) : near;
    gradient = form_.gradient(p);
    if (gradient == Vec3(0)) gradient = {0, 1, 0};

    const Vec3 facing = glm::abs(gradient);
    const int axis = facing.x >= facing.y && facing.x >= facing.z ? 0 : facing.y >= facing.z ? 1 : 2;
    const int face = 2 * axis + (gradient[axis] < 0 ? 0 : 1);
    const auto [along_u, along_v] = cube::along_uv(face, gradient);
    return {p, gradient, cube::uv(face, p), along_u, along_v};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }

  Form form_;
  bool open_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const QuadricValues values{.square = table.vec3("square"),
                             .product = table.vec3("product"),
                             .linear = table.vec3("linear"),
                             .constant = table.number("constant")};
  const Vec3 min = table.vec3("min");
  const Vec3 max = table.vec3("max");
  if (table.failed()) return nullptr;
  if (values.square == Vec3(0) && values.product == Vec3(0) && values.linear == Vec3(0)) {
    table.error("square", "no surface: square, product and linear are all 0");
  } else if (!(min.x < max.x && min.y < max.y && min.z < max.z)) {
    table.error("max", "the box has no volume: max must be above min in each coordinate");
  } else if (const int sign = sign_in_cube(in_cube(values, min, max))) {
    table.error("constant", sign > 0 ? "no surface: the equation's left side is above 0 in the whole box"
                                     : "no surface: the equation's left side is below 0 in the whole box");
  } else {
    out_of_range(table, transform * cube::placed(min, max));
  }
  if (table.failed()) return nullptr;
  return make_quadric(values, min, max, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType quadric_type{.name = "quadric", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_quadric(const QuadricValues& values, const Vec3& min, const Vec3& max, bool open,
                                    const Mat4& transform) {
  return std::make_unique<Quadric>(transform * cube::placed(min, max), in_cube(values, min, max), open);
}

}  // namespace eyeray::engine::shapes
