#include <algorithm>
#include <cmath>

#include "host/records/records.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/revolution.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(A hyperboloid of one sheet, the shape of a cooling tower. Its distance r from the line between `from` and `to`
follows r² = waist² + k² h², where h is the distance from the waist along that line. `radius` is r at `from`,
and `to_radius` is r at `to`. They determine k and the position of the waist, which is between the two ends. A
flat cap closes either end, with normals outward; with `open = true` only the side.

```toml
[[hyperboloid]]
from = [0, 0, 0]
to = [0, 2, 0]
radius = 0.8
to_radius = 0.5
waist = 0.4
material = "wall"
```

`transform` may be any invertible affine map. It may make the hyperboloid elliptic and oblique.

**uv.** On the side u runs from 0 to 1 about the axis, counter-clockwise seen from `to`. u = ½ is towards the
world's +x, or towards +z where the axis is parallel to +x. v runs from 0 at `from` to 1 at `to`. On a cap (½,
½) is the middle, and the rim is ½ away from it. Seen from outside the texture is upright, with u to the right
along that same direction.

**Numeric trap.** The shape is not convex: a ray may enter and leave it twice. It enters through a cap, leaves
into the waist's hollow, enters again and leaves through the other cap. Where a ray runs within the asymptotic
cone of the side, it is inside beyond the roots of the equation, not between them.

**Source.** Any textbook; the cuts after Kay and Kajiya: Ray Tracing Complex Scenes, SIGGRAPH 1986.
)";

constexpr Key keys[] = {
    axis_from_key,
    axis_to_key,
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis at `from`.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "to_radius",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis at `to`. When absent, `radius`.",
     .min = min_radius,
     .max = max_coordinate,
     .optional = true},
    {.name = "waist",
     .type = KeyType::number,
     .doc = "Distance of the side from the axis at the waist, where it is least.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "open", .type = KeyType::boolean, .doc = "If true, the caps are left out.", .fallback = "false"},
};

// The side x² + z² = waist² + square·y², from y = bottom to bottom + 2, with the waist at y = 0. The unit is
// the larger radius across the axis, and half the length along it.
struct Form {
  Form(double radius, double to_radius, double least) {
    const double larger = std::max(radius, to_radius);
    waist = least / larger;
    const auto beyond_waist = [&](double r) {
      return std::sqrt(std::max((r - least) / larger * ((r + least) / larger), 0.0));
    };
    const double below = beyond_waist(radius);
    const double above = beyond_waist(to_radius);
    square = (below + above) * (below + above) / 4;
    bottom = -2 * below / (below + above);
  }

  double waist, square, bottom;
};

class Hyperboloid final : public Revolution {
 public:
  Hyperboloid(const Mat4& to_world, const Form& form, bool open)
      : Revolution(shader::KIND_hyperboloid, to_world,
                   {form.square, 0, form.waist * form.waist, form.bottom, form.bottom + 2}, open,
                   {float(form.square), float(form.waist * form.waist), float(form.bottom)}) {}
};

Mat4 placed(const Vec3& from, const Vec3& to, double larger, const Form& form) {
  return along_axis(from, to, larger, form.bottom, form.bottom + 2);
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 from = table.vec3("from");
  const Vec3 to = table.vec3("to");
  const double radius = table.number("radius");
  const double to_radius = table.has("to_radius") ? table.number("to_radius") : radius;
  const double waist = table.number("waist");
  if (table.failed()) return nullptr;
  const double larger = std::max(radius, to_radius);
  if (from == to) {
    table.error("to", "the axis has no length");
  } else if (waist > std::min(radius, to_radius)) {
    table.error("waist", "the waist is the smallest radius: it must not be above those of the ends");
  } else if (larger - waist < 1e-6 * larger) {
    table.error("waist", "equal radii make a cylinder: use [[cylinder]]");
  } else if (waist < 1e-6 * larger) {
    table.error("waist", "the waist is so narrow that it is a point: use two of [[cone]]");
  } else {
    out_of_range(table, transform * placed(from, to, larger, Form(radius, to_radius, waist)));
  }
  if (table.failed()) return nullptr;
  return make_hyperboloid(from, to, radius, to_radius, waist, table.boolean("open"), transform);
}

}  // namespace

extern const ShapeType hyperboloid_type{
    .name = "hyperboloid", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_hyperboloid(const Vec3& from, const Vec3& to, double radius, double to_radius,
                                        double waist, bool open, const Mat4& transform) {
  const Form form(radius, to_radius, waist);
  return std::make_unique<Hyperboloid>(transform * placed(from, to, std::max(radius, to_radius), form), form,
                                       open);
}

}  // namespace eyeray::engine::shapes
