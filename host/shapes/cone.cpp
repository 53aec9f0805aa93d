#include <utility>

#include "host/records/records.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/revolution.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(The surface between a circle of `radius` about `from` and a circle of `to_radius` about `to`. Each end with a
radius has a flat cap. With `to_radius = 0`, the default, the cone ends in a point. Closed, with normals
outward; with `open = true` only the side.

```toml
[[cone]]
from = [0, 0, 0]
to = [0, 2, 0]
radius = 1
to_radius = 0.25
material = "wall"
```

`transform` may be any invertible affine map. It may make the cone elliptic and oblique. The radii must
differ: with equal radii the shape is a [cylinder](#cylinder).

**uv.** On the side u runs from 0 to 1 about the axis, counter-clockwise seen from the smaller end. u = ½ is
towards the world's +x, or towards +z where the axis is parallel to +x. v runs from 0 at the larger end to 1
at the smaller. On a cap (½, ½) is the middle, and the rim is ½ away from it. Seen from outside the texture is
upright, with u to the right along that same direction.

**Numeric trap.** The equation of the side also describes its mirror image beyond the apex, and a ray may be
inside both. Where the ray runs along the side, the quadratic equation is linear. Sides and caps are cut as
those of a cylinder.

**Source.** Eberly: Intersection of a Line and a Cone, Geometric Tools, 2000.
)";

constexpr Key keys[] = {
    axis_from_key,
    axis_to_key,
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis at `from`.",
     .min = 0,
     .max = max_coordinate},
    {.name = "to_radius",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis at `to`.",
     .fallback = "0",
     .min = 0,
     .max = max_coordinate},
    {.name = "open", .type = KeyType::boolean, .doc = "If true, the caps are left out.", .fallback = "false"},
};

// From the radius 1 at y = 0 to 1 − taper at y = 1.
class Cone final : public Revolution {
 public:
  Cone(const Mat4& to_world, double taper, bool open)
      : Revolution(shader::KIND_cone, to_world, {taper * taper, -taper, 1, 0, 1}, open, {float(taper)}) {}
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 from = table.vec3("from");
  const Vec3 to = table.vec3("to");
  const double radius = table.number("radius");
  const double to_radius = table.number("to_radius");
  if (table.failed()) return nullptr;
  const double larger = std::max(radius, to_radius);
  if (from == to) {
    table.error("to", "the axis has no length");
  } else if (larger < min_radius) {
    table.error("radius", "the cone has no volume: one radius must be above 0");
  } else if (std::fabs(radius - to_radius) < 1e-6 * larger) {
    table.error("to_radius", "equal radii make a cylinder: use [[cylinder]]");
  } else {
    out_of_range(table, transform * along_axis(from, to, larger, 0, 1));
  }
  if (table.failed()) return nullptr;
  return make_cone(from, to, radius, to_radius, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType cone_type{.name = "cone", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_cone(Vec3 from, Vec3 to, double radius, double to_radius, bool open,
                                 const Mat4& transform) {
  if (radius < to_radius) {
    std::swap(from, to);
    std::swap(radius, to_radius);
  }
  return std::make_unique<Cone>(transform * along_axis(from, to, radius, 0, 1), 1 - to_radius / radius, open);
}

}  // namespace eyeray::engine::shapes
