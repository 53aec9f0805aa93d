#include "host/records/records.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/revolution.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(A bowl. At the height h above the tip, its distance from the line between `tip` and `to` is `radius` · √(h /
H), where H is the total height. A flat cap closes it at `to`, with normals outward; with `open = true` only
the bowl.

```toml
[[paraboloid]]
tip = [0, 0, 0]
to = [0, 1, 0]
radius = 0.8
open = true
material = "wall"
```

As a mirror it focuses light that arrives along its axis in one point, radius² / 4H above the tip.

`transform` may be any invertible affine map. It may make the paraboloid elliptic and oblique.

**uv.** On the bowl u runs from 0 to 1 about the axis, counter-clockwise seen from `to`. u = ½ is towards the
world's +x, or towards +z where the axis is parallel to +x. v = h / H. On the cap (½, ½) is the middle, and
the rim is ½ away from it. Seen from outside the texture is upright, with u to the right along that same
direction.

**Numeric trap.** Along the axis the quadratic equation is linear. Near the tip the error of √h is much larger
than that of h. So a hit is moved back onto the bowl along its normal, not at its height. Bowl and cap are cut
as those of a cylinder.

**Source.** Any textbook; the cuts after Kay and Kajiya: Ray Tracing Complex Scenes, SIGGRAPH 1986.
)";

constexpr Key keys[] = {
    {.name = "tip",
     .type = KeyType::vec3,
     .doc = "The point of the bowl that lies on its axis.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "to",
     .type = KeyType::vec3,
     .doc = "End of the axis: the middle of the rim.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the rim from the axis.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "open", .type = KeyType::boolean, .doc = "If true, the cap is left out.", .fallback = "false"},
};

// x² + z² = y, up to y = 1.
class Paraboloid final : public Revolution {
 public:
  Paraboloid(const Mat4& to_world, bool open)
      : Revolution(shader::KIND_paraboloid, to_world, {0, 0.5, 0, 0, 1}, open) {}
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 tip = table.vec3("tip");
  const Vec3 to = table.vec3("to");
  const double radius = table.number("radius");
  if (table.failed()) return nullptr;
  if (tip == to) {
    table.error("to", "the axis has no length");
    return nullptr;
  }
  if (out_of_range(table, transform * along_axis(tip, to, radius, 0, 1))) return nullptr;
  return make_paraboloid(tip, to, radius, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType paraboloid_type{.name = "paraboloid", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_paraboloid(const Vec3& tip, const Vec3& to, double radius, bool open,
                                       const Mat4& transform) {
  return std::make_unique<Paraboloid>(transform * along_axis(tip, to, radius, 0, 1), open);
}

}  // namespace eyeray::engine::shapes
