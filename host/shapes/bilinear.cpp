#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

using Corners = std::array<Vec3, 4>;

constexpr std::string_view manual =
    R"(The saddle-shaped surface between four corners. Straight lines join each pair of opposite edges: (1 − u)(1 −
v)·p₀ + u(1 − v)·p₁ + uv·p₂ + (1 − u)v·p₃. `corners` run around it. Open; the normal points to the side from
which they run counter-clockwise.

```toml
[[bilinear]]
corners = [[-1, 0, 1], [1, 1, 1], [1, 0, -1], [-1, 1, -1]]
material = "wall"
```

Corners in one plane are refused, and so are corners so near to one that the patch is flatter than 1e-4. Use
two triangles for those. `transform` may be any invertible affine map.

**uv.** (0, 0) at the first corner, (1, 0) at the second, (1, 1) at the third, (0, 1) at the fourth.

**Numeric trap.** Where the patch is nearly a parallelogram, the quadratic equation for u is nearly linear,
and its other root exceeds all bounds. The roots are computed as q/c and a/q. A ray is first followed to a
point near the middle.

**Source.** Reshetov: Cool Patches, Ray Tracing Gems, 2019, chapter 8.
)";

constexpr Key keys[] = {
    {.name = "corners",
     .type = KeyType::vec3_list,
     .doc = "The four corners, around the patch.",
     .min = -max_coordinate,
     .max = max_coordinate},
};

// Six times the volume of the corners' tetrahedron, as a share of the cube of its longest edge or diagonal.
double thickness(const Corners& p) {
  double longest = 0;
  for (const Vec3& a : p)
    for (const Vec3& b : p) longest = std::max(longest, glm::length(a - b));
  if (longest == 0) return 0;
  const Vec3 x = (p[1] - p[0]) / longest, y = (p[3] - p[0]) / longest, z = (p[2] - p[0]) / longest;
  return std::fabs(glm::dot(glm::cross(x, y), z));
}
constexpr double least_thickness = 1e-4;

class Bilinear final : public Shape {
 public:
  Bilinear(const Corners& corners, bool mirrored) : corners_(corners), mirrored_(mirrored) {
    // A point's weights, those of the tetrahedron's corners, are linear in the point.
    const Mat3 edges(p(1) - p(0), p(2) - p(0), p(3) - p(0));
    to_weights_ = glm::inverse(edges);
  }

  // A point of space is on the surface if its weights fulfil w₀·w₂ = w₁·w₃, and within the patch if no weight
  // is negative.
  std::optional<Intersection> intersect(const Ray& ray) const override {
    const Vec3 middle = (p(0) + p(1) + p(2) + p(3)) * 0.25;
    const double start = glm::dot(middle - ray.o, ray.d) / glm::dot(ray.d, ray.d);
    const Vec4 at = weights(ray.o + ray.d * start - p(0));
    const Vec3 slope = to_weights_ * ray.d;
    const Vec4 rise(-slope.x - slope.y - slope.z, slope);
    const double a = rise[0] * rise[2] - rise[1] * rise[3];
    const double b = 0.5 * (at[0] * rise[2] + rise[0] * at[2] - at[1] * rise[3] - rise[1] * at[3]);
    const double c = at[0] * at[2] - at[1] * at[3];
    std::optional<Intersection> nearest;
    for (const double s : quadratic_roots(a, b, c)) {
      const Vec4 w = at + rise * s;
      const double t = start + s;
      const Vec2 uv(w[1] + w[2], w[2] + w[3]);
      const bool within = uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
      if (within && t > 0 && std::isfinite(t) && (!nearest || t < nearest->t)) nearest = {t, uv.x, uv.y};
    }
    return nearest;
  }

  SurfacePoint surface(const Ray&, const Intersection& hit) const override {
    const double u = hit.u, v = hit.v;
    SurfacePoint surface;
    surface.position =
        p(0) * ((1 - u) * (1 - v)) + p(1) * (u * (1 - v)) + p(2) * (u * v) + p(3) * ((1 - u) * v);
    // The flatter the patch, the more the rounding of the weights moves t.
    const double reach = std::max({magnitude(p(0)), magnitude(p(1)), magnitude(p(2)), magnitude(p(3))});
    surface.position_error = 1e-14 * reach / thickness(corners_) + 1e-13 * reach;
    const Vec3 along_u = (p(1) - p(0)) * (1 - v) + (p(2) - p(3)) * v;
    const Vec3 along_v = (p(3) - p(0)) * (1 - u) + (p(2) - p(1)) * u;
    surface.normal_geometric = unit(glm::cross(along_u, along_v)) * (mirrored_ ? -1.0 : 1.0);
    surface.normal = surface.normal_geometric;
    surface.uv = inner_uv({u, v});
    surface.along_u = along_u;
    surface.along_v = along_v;
    return surface;
  }

  Bounds bounds() const override {
    Bounds bounds;
    for (const Vec3& corner : corners_) bounds.include(corner);
    return bounds;
  }

  double thickness_margin() const override { return thickness(corners_) / least_thickness; }

  void pack(records::Packer& packer) const override {
    const Vec3 last = packer.relative(p(2));
    packer.add(records::Packer::primitive(
        shader::KIND_bilinear, material, records::to_vec4(packer.relative(p(0)), last.x),
        records::to_vec4(packer.relative(p(1)), last.y), records::to_vec4(packer.relative(p(3)), last.z),
        mirrored_ ? 1 : 0));
  }

 private:
  const Vec3& p(size_t i) const { return corners_[i]; }
  Vec4 weights(const Vec3& from_first) const {
    const Vec3 others = to_weights_ * from_first;
    return {1 - others.x - others.y - others.z, others};
  }

  Corners corners_;
  bool mirrored_;
  Mat3 to_weights_;
};

Corners transformed(Corners corners, const Affine& map) {
  for (Vec3& corner : corners) corner = map.point(corner);
  return corners;
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const std::vector<Vec3> list = table.vec3_list("corners");
  if (table.failed()) return nullptr;
  if (list.size() != 4) {
    table.error("corners", fmt::format("a bilinear patch needs exactly 4, not {}", list.size()));
    return nullptr;
  }
  const Corners corners{list[0], list[1], list[2], list[3]};
  if (!(thickness(corners) >= least_thickness)) {
    table.error("corners", "the patch is flat: its corners lie in one plane; use two triangles");
    return nullptr;
  }
  const Corners world = transformed(corners, Affine(transform));
  for (const Vec3& corner : world) {
    if (magnitude(corner) <= max_coordinate) continue;
    table.error("transform", "the transformed corners are out of range (coordinates up to 1e12)");
    return nullptr;
  }
  if (!(thickness(world) >= least_thickness)) {
    table.error("transform", "the transform leaves the patch flat");
    return nullptr;
  }
  return make_bilinear(corners, transform);
}

}  // namespace

extern const ShapeType bilinear_type{.name = "bilinear", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_bilinear(const std::array<Vec3, 4>& corners, const Mat4& transform) {
  const Affine map(transform);
  return std::make_unique<Bilinear>(transformed(corners, map), map.mirrors());
}

}  // namespace eyeray::engine::shapes
