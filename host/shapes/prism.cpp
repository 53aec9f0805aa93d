#include <algorithm>
#include <cmath>

#include "host/records/records.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/plane_axes.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(The body that an outline, minus its holes, sweeps along `extrusion`: all points p + s·extrusion with p in the
polygon and s from 0 to 1. Closed; the normals point outward, also into holes.

```toml
[[prism]]
vertices = [[0, 0, 0], [3, 0, 0], [3, 0, 2], [2, 0, 2], [2, 0, 1], [0, 0, 1]]
holes = [[[2.2, 0, 0.3], [2.7, 0, 0.3], [2.7, 0, 0.8]]]
extrusion = [0, 0.5, 0]
material = "wall"
```

`transform` may be any invertible affine map. The extrusion may be oblique, and outline and holes may run in
either direction. The rules for outlines are those of the [polygon](#polygon).

**uv.** In the prism's own units, before `transform`. On a wall u is the length along the outline, or the
hole, from its first vertex, to the right seen from outside. v is the share of the extrusion times its length.
On the cap at the tip of the extrusion, uv are distances from the first vertex along two axes, as on a polygon
with the same normal. On the other cap u is negated, so that the texture is not mirrored seen from outside.

**Numeric trap.** Walls and caps that are tested separately let rays through where they meet. Here the ray,
seen along the extrusion, is a line that passes the outline's edges at an even number of distances. A cap is
hit where an odd number of these distances are less than its own.

**Source.** Kajiya: New Techniques for Ray Tracing Procedurally Defined Objects, SIGGRAPH 1983, section 4 (prisms).
)";

constexpr Key keys[] = {
    vertices_key,
    holes_key,
    {.name = "extrusion",
     .type = KeyType::vec3,
     .doc = "Direction and distance of the sweep.",
     .min = -max_coordinate,
     .max = max_coordinate},
};

// A prism has no height if less than this share of the extrusion points off the outline's plane.
constexpr double least_height = 1e-6;

// Intersection::u: the part hit. Walls count on from there.
constexpr double bottom_cap = 0;
constexpr double top_cap = 1;
constexpr size_t first_wall = 2;

// A prism in object space: the outline in the xz plane, |x|, |z| ≤ 1, from y = −1 to y = 1.
struct PrismForm {
  struct Wall {
    Vec2 from, to;
    double u_from, u_to;
    Vec2 normal;  // unit, outward
  };

  Mat4 to_world;
  std::vector<std::vector<Vec2>>
      outlines;  // x and z; the outer one and the holes run with the body to the left
  std::vector<Wall> walls;
  double height;
  Vec3 u_cap, v_cap;  // u = u_cap · (x, z, 1) on the cap at y = 1

  // uv of the caps are distances from `origin`.
  PrismForm(const PlanarRegion& region, const Vec3& extrusion, const Vec3& origin);
  std::vector<float> parameters() const;
};

PrismForm::PrismForm(const PlanarRegion& region, const Vec3& extrusion, const Vec3& origin)
    : height(glm::length(extrusion)) {
  // Axes that are right-handed seen from the tip, and the bounds along them.
  const Vec3 flat_normal = region.normal();
  const auto [u, v] = plane_axes(glm::dot(flat_normal, extrusion) < 0 ? -flat_normal : flat_normal);
  std::vector<std::vector<Vec2>> flat;
  const auto lay_flat = [&, u = u, v = v](const Outline& written) {
    flat.emplace_back();
    for (const Vec3& p : written) flat.back().emplace_back(glm::dot(u, p - origin), glm::dot(v, p - origin));
  };
  lay_flat(region.outer);
  for (const Outline& hole : region.holes) lay_flat(hole);
  Vec2 low = flat[0][0], high = low;
  for (const auto& outline : flat)
    for (const Vec2& point : outline) {
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  const Vec2 middle = (low + high) * 0.5, half = (high - low) * 0.5;
  to_world = Mat4(Vec4(u * half.x, 0), Vec4(extrusion * 0.5, 0), Vec4(v * half.y, 0),
                  Vec4(origin + u * middle.x + v * middle.y + extrusion * 0.5, 1));
  u_cap = {half.x, 0, middle.x};
  v_cap = {0, half.y, middle.y};

  for (size_t k = 0; k < flat.size(); ++k) {
    // Within an odd number of other outlines it is that of a hole.
    std::vector<Vec2> outline = flat[k];
    bool hole = false;
    for (size_t other = 0; other < flat.size(); ++other)
      if (other != k && winding(flat[other], outline[0]) != 0) hole = !hole;
    if ((signed_area(outline) < 0) != hole) std::reverse(outline.begin() + 1, outline.end());
    double length = 0;
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vec2 from = outline[i], to = outline[(i + 1) % outline.size()];
      const Vec2 a = (from - middle) / half, b = (to - middle) / half;
      const double so_far = length;
      length += glm::length(to - from);
      walls.push_back({a, b, so_far, length, glm::normalize(Vec2(b.y - a.y, a.x - b.x))});
    }
    for (Vec2& point : outline) point = (point - middle) / half;
    outlines.push_back(std::move(outline));
  }
}

std::vector<float> PrismForm::parameters() const {
  std::vector<float> all;
  const auto add = [&](double x, double y, double z, double w) {
    for (const double value : {x, y, z, w}) all.push_back(float(value));
  };
  add(double(walls.size()), height, 0, 0);
  add(u_cap.x, u_cap.y, u_cap.z, 0);
  add(v_cap.x, v_cap.y, v_cap.z, 0);
  for (const Wall& wall : walls) add(wall.from.x, wall.from.y, wall.to.x, wall.to.y);
  for (const Wall& wall : walls) add(wall.u_from, wall.u_to, wall.normal.x, wall.normal.y);
  return all;
}

class Prism final : public ObjectShape {
 public:
  explicit Prism(PrismForm form, const Mat4& transform)
      : ObjectShape(shader::KIND_prism, transform * form.to_world, form.parameters(), form.walls.size()),
        form_(std::move(form)) {}

  bool is_closed() const override { return true; }
  ShapeForm form() const override { return ExtrusionForm{to_world().matrix(), form_.outlines}; }

 private:
  // Tests each face by itself: a wall where the line hits its plane between its ends, a cap where the
  // outlines wind around the point.
  Crossings crossings(const Ray& ray) const override {
    constexpr double room = 1e-14;  // for edges, where faces join
    const Vec3 &o = ray.o, &d = ray.d;
    const Vec2 start(o.x, o.z), line(d.x, d.z);
    Crossings all;
    for (size_t i = 0; i < form_.walls.size(); ++i) {
      const auto& wall = form_.walls[i];
      const Vec2 along = wall.to - wall.from, to_wall = wall.from - start;
      const double across = line.x * along.y - line.y * along.x;
      if (across == 0) continue;
      const double share = (to_wall.x * line.y - to_wall.y * line.x) / across;
      const double t = (to_wall.x * along.y - to_wall.y * along.x) / across;
      if (share >= -room && share <= 1 + room && std::fabs(o.y + t * d.y) <= 1 + room)
        all.add({t, double(first_wall + i), 0});
    }
    if (d.y == 0) return all;
    for (const double cap : {bottom_cap, top_cap}) {
      const double t = ((cap == top_cap ? 1 : -1) - o.y) / d.y;
      const Vec2 point = start + line * t;
      int turns = 0;
      for (const auto& outline : form_.outlines) turns += winding(outline, point);
      if (turns != 0) all.add({t, cap, 0});
    }
    return all;
  }

  Point point(const Vec3& near, const Intersection& hit) const override {
    if (hit.u < double(first_wall)) {
      const double up = hit.u == top_cap ? 1 : -1;
      const Vec3 homogeneous(near.x, near.z, 1);
      const glm::dmat2 axes(up * form_.u_cap.x, form_.v_cap.x, up * form_.u_cap.y, form_.v_cap.y);
      const auto on_cap = [](const Vec2& d) { return Vec3(d.x, 0, d.y); };
      return {{near.x, up, near.z},
              {0, up, 0},
              {up * glm::dot(form_.u_cap, homogeneous), glm::dot(form_.v_cap, homogeneous)},
              on_cap(glm::inverse(axes)[0]),
              on_cap(glm::inverse(axes)[1])};
    }
    const auto& wall = form_.walls[size_t(hit.u) - first_wall];
    const Vec2 along = wall.to - wall.from;
    const double share =
        std::clamp(glm::dot(Vec2(near.x, near.z) - wall.from, along) / glm::dot(along, along), 0.0, 1.0);
    const Vec2 foot = wall.from + along * share;
    const double y = std::clamp(near.y, -1.0, 1.0);
    return {{foot.x, y, foot.y},
            {wall.normal.x, 0, wall.normal.y},
            {glm::mix(wall.u_from, wall.u_to, share), form_.height * (0.5 * y + 0.5)},
            Vec3(along.x, 0, along.y) / (wall.u_to - wall.u_from),
            {0, 2 / form_.height, 0}};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }

  PrismForm form_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const auto region = read_region(table);
  const Vec3 extrusion = table.vec3("extrusion");
  if (table.failed() || !region) return nullptr;
  if (extrusion == Vec3(0)) {
    table.error("extrusion", "the prism has no volume: its extrusion has no length");
    return nullptr;
  }
  if (std::fabs(glm::dot(unit(extrusion), region->normal())) < least_height) {
    table.error("extrusion", "the prism has no volume: its extrusion lies in the outline's plane");
    return nullptr;
  }
  if (out_of_range(table, transform * PrismForm(*region, extrusion, region->outer[0]).to_world))
    return nullptr;
  return make_prism(*region, extrusion, transform);
}

}  // namespace

extern const ShapeType prism_type{.name = "prism", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_prism(const PlanarRegion& region, const Vec3& extrusion, const Mat4& transform,
                                  const std::optional<Vec3>& origin) {
  return std::make_unique<Prism>(PrismForm(region, extrusion, origin.value_or(region.outer[0])), transform);
}

}  // namespace eyeray::engine::shapes
