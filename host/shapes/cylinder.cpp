#include "host/records/records.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/revolution.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points at the distance `radius` from the line between `from` and `to`, with a flat cap at either end.
Closed, with normals outward; with `open = true` only the side.

```toml
[[cylinder]]
from = [0, 0, 0]
to = [0, 2, 0]
radius = 0.5
material = "wall"
```

`transform` may be any invertible affine map. It may make the cylinder elliptic and oblique.

**uv.** On the side u runs from 0 to 1 about the axis, counter-clockwise seen from `to`. u = ½ is towards the
world's +x, or towards +z where the axis is parallel to +x. v runs from 0 at `from` to 1 at `to`. On a cap (½,
½) is the middle, and the rim is ½ away from it. Seen from outside the texture is upright, with u to the right
along that same direction.

**Numeric trap.** Along the axis the quadratic equation of the side degenerates. At a rim, a side and a cap
that are tested separately let rays through between them. Here the ray's interval between the planes of the
caps is intersected with its interval inside the side. Both intervals end in the same numbers.

**Source.** Cychosz and Waggenspack: Intersecting a Ray with a Cylinder, Graphics Gems IV, 1994.
)";

constexpr Key keys[] = {
    axis_from_key,
    axis_to_key,
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "open", .type = KeyType::boolean, .doc = "If true, the caps are left out.", .fallback = "false"},
};

class Cylinder final : public Revolution {
 public:
  Cylinder(const Mat4& to_world, bool open)
      : Revolution(shader::KIND_cylinder, to_world, {0, 0, 1, -1, 1}, open) {}
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 from = table.vec3("from");
  const Vec3 to = table.vec3("to");
  const double radius = table.number("radius");
  if (table.failed()) return nullptr;
  if (from == to) {
    table.error("to", "the axis has no length");
    return nullptr;
  }
  if (out_of_range(table, transform * along_axis(from, to, radius, -1, 1))) return nullptr;
  return make_cylinder(from, to, radius, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType cylinder_type{.name = "cylinder", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_cylinder(const Vec3& from, const Vec3& to, double radius, bool open,
                                     const Mat4& transform) {
  return std::make_unique<Cylinder>(transform * along_axis(from, to, radius, -1, 1), open);
}

}  // namespace eyeray::engine::shapes
