#include <cmath>

#include "host/records/records.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points of the plane through `center`, perpendicular to `normal`, at a distance from `inner_radius` to
`radius` from the centre. The shape is a disk, or a ring (an annulus) if it has an inner radius. It is a sheet
without an inside. Its normal points in the direction of `normal`.

```toml
[[disk]]
center = [0, 1, 0]
normal = [0, 1, 0]
radius = 1
inner_radius = 0.5
material = "wall"
```

`transform` may be any invertible affine map. It may make the disk an ellipse.

**uv.** (½, ½) is the centre, and the rim is ½ away from it. The texture lies flat and is cut to the disk.
Seen from the side to which the normal points, u runs to the right and v up. u is as nearly along the world's
+x as possible, or along +z where the normal is parallel to +x.

**Numeric trap.** Far away, o + t·d misses the plane by the rounding of t. So the ray is first followed to its
point nearest to the centre, and the hit is moved back onto the plane. A ray is parallel if it never reaches
the plane. No epsilon decides.

**Source.** Any textbook.
)";

constexpr Key keys[] = {
    center_key,
    {.name = "normal",
     .type = KeyType::vec3,
     .doc = "Direction perpendicular to the disk, of any length but 0."},
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the rim from the centre.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "inner_radius",
     .type = KeyType::number,
     .doc = "Radius of the hole in the middle.",
     .fallback = "0",
     .min = 0,
     .max = max_coordinate},
};

// y = 0, inner ≤ the distance from the origin ≤ 1.
class Disk final : public ObjectShape {
 public:
  Disk(const Mat4& to_world, double inner)
      : ObjectShape(shader::KIND_disk, to_world, {float(inner * inner)}), inner_(inner) {}

  ShapeForm form() const override { return DiskForm{to_world().matrix(), inner_}; }

 private:
  Crossings crossings(const Ray& ray) const override {
    Crossings crossings;
    if (ray.d.y == 0) return crossings;
    const double t = -ray.o.y / ray.d.y;
    const double distance = std::hypot(ray.o.x + t * ray.d.x, ray.o.z + t * ray.d.z);
    if (distance >= inner_ && distance <= 1) crossings.add({t, 0, 0});
    return crossings;
  }

  Point point(const Vec3& near, const Intersection&) const override {
    return {{near.x, 0, near.z}, {0, 1, 0}, {0.5 + 0.5 * near.x, 0.5 - 0.5 * near.z}, {2, 0, 0}, {0, 0, -2}};
  }

  Bounds extent() const override { return {{-1, 0, -1}, {1, 0, 1}}; }

  double inner_;
};

Mat4 placed(const Vec3& center, const Vec3& normal, double radius) {
  return along_axis(center, center + unit(normal) * radius, radius, 0, 1);
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 center = table.vec3("center");
  const Vec3 normal = table.vec3("normal");
  const double radius = table.number("radius");
  const double inner_radius = table.number("inner_radius");
  if (table.failed()) return nullptr;
  if (normal == Vec3(0)) table.error("normal", "the normal has no length");
  if (inner_radius >= radius)
    table.error("inner_radius", "the hole leaves nothing: inner_radius must be below radius");
  if (table.failed() || out_of_range(table, transform * placed(center, normal, radius))) return nullptr;
  return make_disk(center, normal, radius, inner_radius, transform);
}

}  // namespace

extern const ShapeType disk_type{
    .name = "disk", .manual = manual, .keys = keys, .parse = parse, .flat = true};

std::unique_ptr<Shape> make_disk(const Vec3& center, const Vec3& normal, double radius, double inner_radius,
                                 const Mat4& transform) {
  return std::make_unique<Disk>(transform * placed(center, normal, radius), inner_radius / radius);
}

}  // namespace eyeray::engine::shapes
