#include "host/records/records.hpp"
#include "host/shapes/cube.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points between `min` and `max` in each coordinate. Closed; the normals point outward.

```toml
[[box]]
min = [-1, 0, -1]
max = [1, 2, 1]
material = "wall"
```

`transform` may be any invertible affine map: rotated, sheared and mirrored boxes are boxes too.

**uv.** Each face shows the whole texture upright. Seen from outside, u runs from 0 on its left to 1 on its
right, and v from 0 at its foot to 1 at its top. The upper edge of the top face is at −z, and that of the
bottom face at +z.

**Numeric trap.** (x − o) / d is 0 / 0 for a ray that runs within a face's plane. The min and max of that
depend on the compiler. Directions that are nearly 0 are made slightly larger, so that no NaN arises.

**Source.** Kay and Kajiya: Ray Tracing Complex Scenes, SIGGRAPH 1986.
)";

constexpr Key keys[] = {
    box_min_key,
    box_max_key,
};

// The cube from −1 to 1.
class Box final : public ObjectShape {
 public:
  explicit Box(const Mat4& to_world) : ObjectShape(shader::KIND_box, to_world) {}

  bool is_closed() const override { return true; }
  ShapeForm form() const override { return BoxForm{to_world().matrix()}; }

 private:
  // A crossing's u is the number of its face.
  Crossings crossings(const Ray& ray) const override {
    Crossings both;
    if (const auto span = cube::span(ray)) {
      both.add({span->in.t, double(span->in.face), 0});
      both.add({span->out.t, double(span->out.face), 0});
    }
    return both;
  }

  Point point(const Vec3& near, const Intersection& hit) const override {
    const int face = int(hit.u);
    const Vec3 p = cube::onto(face, near);
    const auto [along_u, along_v] = cube::along_uv(face, cube::normal(face));
    return {p, cube::normal(face), cube::uv(face, p), along_u, along_v};
  }

  Bounds extent() const override { return {Vec3(-1), Vec3(1)}; }
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 min = table.vec3("min");
  const Vec3 max = table.vec3("max");
  if (table.failed()) return nullptr;
  if (!(min.x < max.x && min.y < max.y && min.z < max.z)) {
    table.error("max", "the box has no volume: max must be above min in each coordinate");
    return nullptr;
  }
  if (out_of_range(table, transform * cube::placed(min, max))) return nullptr;
  return make_box(min, max, transform);
}

}  // namespace

extern const ShapeType box_type{.name = "box", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_box(const Vec3& min, const Vec3& max, const Mat4& transform) {
  return std::make_unique<Box>(transform * cube::placed(min, max));
}

}  // namespace eyeray::engine::shapes
