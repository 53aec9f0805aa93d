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
    R"((x/a)² + (y/b)² + (z/c)² = 1 about `center`, for `radii` = [a, b, c]. Closed; the normals point outward.

```toml
[[ellipsoid]]
center = [0, 1, 0]
radii = [2, 1, 0.5]
material = "glass"
```

`transform` may be any invertible affine map. The result is an ellipsoid again.

**uv.** As on a [sphere](#sphere) that is stretched to this ellipsoid.

**Numeric trap.** As for a sphere, in a space in which the ellipsoid is one. From far away, the ray is first
followed to its point nearest to the centre. Values computed from there are of the ellipsoid's own size.

**Source.** Haines, Günther, Akenine-Möller: Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems,
chapter 7, 2019.
)";

constexpr Key keys[] = {
    center_key,
    radii_key,
};

// The unit sphere.
class Ellipsoid final : public ObjectShape {
 public:
  explicit Ellipsoid(const Mat4& to_world) : ObjectShape(shader::KIND_ellipsoid, to_world) {}

  Bounds bounds() const override {
    const Mat3 rows = glm::transpose(to_world().linear);
    const Vec3 reach(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    return {to_world().offset - reach, to_world().offset + reach};
  }

  bool is_closed() const override { return true; }
  ShapeForm form() const override {
    return QuadricForm{.to_world = to_world().matrix(),
                       .square = Vec3(1),
                       .product = Vec3(0),
                       .linear = Vec3(0),
                       .constant = -1,
                       .clip = {Vec3(-2), Vec3(2)},
                       .open = false};
  }

 private:
  Crossings crossings(const Ray& ray) const override {
    Crossings both;
    for (const double t :
         quadratic_roots(glm::dot(ray.d, ray.d), glm::dot(ray.o, ray.d), glm::dot(ray.o, ray.o) - 1))
      both.add({t, 0, 0});
    return both;
  }

  Point point(const Vec3& near, const Intersection&) const override {
    const Vec3 n = unit(near);
    const double u = 0.5 + std::atan2(-n.z, n.x) / (2 * std::numbers::pi);
    const double from_axis = std::hypot(n.x, n.z);
    return {n,
            n,
            {u < 1 ? u : 0, std::atan2(from_axis, -n.y) / std::numbers::pi},
            along_turn(n),
            along_meridian(n)};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }
};

Mat4 placed(const Vec3& center, const Vec3& radii) {
  return {{radii.x, 0, 0, 0}, {0, radii.y, 0, 0}, {0, 0, radii.z, 0}, {center, 1}};
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 center = table.vec3("center");
  const Vec3 radii = table.vec3("radii");
  if (table.failed() || out_of_range(table, transform * placed(center, radii))) return nullptr;
  return make_ellipsoid(center, radii, transform);
}

}  // namespace

extern const ShapeType ellipsoid_type{.name = "ellipsoid", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_ellipsoid(const Vec3& center, const Vec3& radii, const Mat4& transform) {
  return std::make_unique<Ellipsoid>(transform * placed(center, radii));
}

}  // namespace eyeray::engine::shapes
