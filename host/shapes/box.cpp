#include <cmath>

#include "records/records.hpp"
#include "shapes/make.hpp"
#include "shapes/object_shape.hpp"

namespace eyeray {

namespace {

constexpr std::string_view manual =
    R"(All points between `min` and `max`, in each coordinate. Closed; the normals point outward.

```toml
[[box]]
min = [-1, 0, -1]
max = [1, 2, 1]
material = "wall"
```

`transform` may be any affine map that can be undone: turned, sheared and mirrored boxes are boxes too.

**uv.** Each face has the whole texture upright: seen from outside u runs from 0 on its left to 1 on its right and v from 0 at its foot to 1.
On top of the top face is −z, and of the bottom face +z.

**Numeric trap.** (x − o) / d is 0 / 0 for a ray that runs within a face's plane, and min and max of that are whatever the compiler likes. Directions
that are as good as 0 are taken as a little larger, so that no NaN arises.

**Source.** Kay and Kajiya: Ray Tracing Complex Scenes, SIGGRAPH 1986.
)";

constexpr Key keys[] = {
    {.name = "min",
     .type = KeyType::vec3,
     .doc = "The corner with the least coordinates.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "max",
     .type = KeyType::vec3,
     .doc = "The corner with the greatest.",
     .min = -max_coordinate,
     .max = max_coordinate},
};

// The cube from −1 to 1.
class Box final : public ObjectShape {
 public:
  explicit Box(const Mat4& to_world) : ObjectShape(shader::KIND_box, to_world) {}

 private:
  // Each face by itself; u = its number, 2 · axis, and 1 more for the upper.
  Crossings crossings(const Ray& ray) const override {
    double in = -HUGE_VAL, out = HUGE_VAL;
    int in_face = 0, out_face = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (ray.d[axis] == 0) {
        if (std::fabs(ray.o[axis]) > 1) return {};
        continue;
      }
      const bool up = ray.d[axis] > 0;
      const double enter = ((up ? -1 : 1) - ray.o[axis]) / ray.d[axis];
      const double leave = ((up ? 1 : -1) - ray.o[axis]) / ray.d[axis];
      if (enter > in) {
        in = enter;
        in_face = 2 * axis + (up ? 0 : 1);
      }
      if (leave < out) {
        out = leave;
        out_face = 2 * axis + (up ? 1 : 0);
      }
    }
    Crossings both;
    if (in <= out) {
      both.add({in, double(in_face), 0});
      both.add({out, double(out_face), 0});
    }
    return both;
  }

  Point point(const Vec3& near, const Intersection& hit) const override {
    const int axis = int(hit.u) / 2;
    const double side = int(hit.u) % 2 == 1 ? 1 : -1;
    Point point{glm::clamp(near, -1.0, 1.0), Vec3(0), Vec2(0)};
    point.position[axis] = side;
    point.gradient[axis] = side;
    const Vec3& p = point.position;
    const Vec2 right_and_up[] = {{-p.z * side, p.y}, {p.x, -p.z * side}, {p.x * side, p.y}};
    point.uv = right_and_up[axis] * 0.5 + 0.5;
    return point;
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }
};

Mat4 placed(const Vec3& min, const Vec3& max) {
  const Vec3 half = (max - min) * 0.5;
  return {{half.x, 0, 0, 0}, {0, half.y, 0, 0}, {0, 0, half.z, 0}, {min + half, 1}};
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 min = table.vec3("min");
  const Vec3 max = table.vec3("max");
  if (table.failed()) return nullptr;
  if (!(min.x < max.x && min.y < max.y && min.z < max.z)) {
    table.error("max", "the box has no volume: max must be above min in each coordinate");
    return nullptr;
  }
  if (out_of_range(table, transform * placed(min, max))) return nullptr;
  return make_box(min, max, transform);
}

}  // namespace

extern const ShapeType box_type{.name = "box", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_box(const Vec3& min, const Vec3& max, const Mat4& transform) {
  return std::make_unique<Box>(transform * placed(min, max));
}

}  // namespace eyeray
