#include <cmath>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/plane_axes.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points x with normal · (x − point) = 0, infinite in all directions. The side to which the normal points is
outside: a medium fills the half-space behind the plane.

```toml
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
```

`transform` may be any invertible affine map.

**uv.** Distances from `point` along two axes U and V in the plane, with (U, V, normal) right-handed. U is
`u_axis` projected onto the plane. Without `u_axis`, U is horizontal, +y × normal. On a wall seen from
outside, u then runs to the right and v up. Where the normal is vertical (its x and z below 1e-6 of its
length), U is +x. V is then −z on a floor. A `transform` stretches and rotates the pattern with the plane: uv
are in the plane's own units, before `transform`.

**Numeric trap.** Far away, o + t·d misses the plane by the rounding of t, so the hit is moved back onto the
plane. A ray is parallel only if normal · d = 0 exactly. No epsilon decides, because a nearly parallel ray
does hit the plane far away.

**Source.** Any textbook; the projection after Wächter, Binder: A Fast and Robust Method for Avoiding Self-Intersection,
Ray Tracing Gems, chapter 6, 2019.
)";

constexpr Key keys[] = {
    {.name = "point",
     .type = KeyType::vec3,
     .doc = "A point of the plane. It is the origin of uv.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "normal", .type = KeyType::vec3, .doc = "Direction to the outside, of any length but 0."},
    {.name = "u_axis",
     .type = KeyType::vec3,
     .doc = "Direction along which u grows, projected onto the plane.",
     .optional = true},
};

class Plane final : public Shape {
 public:
  // All arguments are in the world; the gradients of u and v lie in the plane.
  Plane(const Vec3& point, const Vec3& normal, const Vec3& u_gradient, const Vec3& v_gradient)
      : point_(point), normal_(normal), u_gradient_(u_gradient), v_gradient_(v_gradient) {}

  std::optional<Intersection> intersect(const Ray& ray) const override {
    const double t = glm::dot(normal_, point_ - ray.o) / glm::dot(normal_, ray.d);
    if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
    return Intersection{t, 0, 0};
  }

  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    const Vec3 from_point = tangential((ray.o - point_) + ray.d * hit.t, normal_);
    const double error = 1e-13 * (magnitude(point_) + magnitude(from_point));
    const Vec2 uv(glm::dot(u_gradient_, from_point), glm::dot(v_gradient_, from_point));
    SurfacePoint surface{point_ + from_point, error, normal_, normal_, uv};
    set_along(surface, u_gradient_, v_gradient_);
    return surface;
  }

  Bounds bounds() const override { return Bounds::unbounded(); }

  ShapeForm form() const override { return PlaneForm{point_, normal_}; }

  void pack(records::Packer& packer) const override {
    const Vec3 point = packer.relative(point_);
    packer.add(records::Packer::primitive(shader::KIND_plane, material,
                                          records::to_vec4(normal_, glm::dot(normal_, point)),
                                          records::to_vec4(u_gradient_, -glm::dot(u_gradient_, point)),
                                          records::to_vec4(v_gradient_, -glm::dot(v_gradient_, point))));
  }

 private:
  Vec3 point_;
  Vec3 normal_;
  Vec3 u_gradient_;  // u = u_gradient · (x − point)
  Vec3 v_gradient_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 point = table.vec3("point");
  const Vec3 normal = table.vec3("normal");
  std::optional<Vec3> u_axis;
  if (table.has("u_axis")) u_axis = table.vec3("u_axis");
  if (table.failed()) return nullptr;

  // Check that every direction has a length, before and after the map.
  if (normal == Vec3(0)) {
    table.error("normal", "the normal has no length");
  } else if (u_axis) {
    const std::string why = why_no_u_axis(normal, *u_axis);
    if (!why.empty()) table.error("u_axis", why);
  }
  if (!(magnitude(Affine(transform).point(point)) <= max_coordinate)) {
    table.error("transform", "the transformed point is out of range (coordinates up to 1e12)");
  }
  if (table.failed()) return nullptr;
  return make_plane(point, normal, transform, u_axis);
}

}  // namespace

extern const ShapeType plane_type{
    .name = "plane", .manual = manual, .keys = keys, .parse = parse, .bounded = false, .flat = true};

std::unique_ptr<Shape> make_plane(const Vec3& point, const Vec3& normal, const Mat4& transform,
                                  const std::optional<Vec3>& u_axis) {
  const Affine map(transform);

  // Lay the axes in the plane's own space, where uv are distances.
  const Vec3 n = unit(normal);
  const auto [u, v] = plane_axes(n, u_axis);

  // Gradients map as normals do, but keep their length; their component off the plane need not count.
  const Vec3 world_normal = map.normal(n);
  return std::make_unique<Plane>(map.point(point), world_normal, tangential(map.cotangent * u, world_normal),
                                 tangential(map.cotangent * v, world_normal));
}

}  // namespace eyeray::engine::shapes
