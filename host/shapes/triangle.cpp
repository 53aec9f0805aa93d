#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(The flat area between three vertices: x = w₀·v₀ + w₁·v₁ + w₂·v₂ with weights ≥ 0 that sum to 1, edges
included. The normal points to the side from which the vertices run counter-clockwise.

```toml
[[triangle]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
uv = [[0, 0], [1, 0], [0, 1]]
material = "wall"
```

`transform` may be any invertible affine map. Under a mirroring map the outside stays outside. All normals of
a closed dielectric mesh must point outward: they decide whether a ray enters or leaves the glass.

**normals** (three, of any length but 0, each on the side of the geometric normal) are interpolated for
shading, before any transform. **uv** (three) are interpolated for textures. Without them, u and v are the
weights of the second and third vertex.

**Numeric trap.** Methods that compare barycentrics with 0 after a division (Möller–Trumbore) let rays through
between two neighbours: one in ten of those aimed at an edge. Here the vertices are sheared into the plane
perpendicular to the ray, in the same way for all triangles. The signs of the three edge functions a·d − b·c
decide. They are exact or zero, for both neighbours, and zero counts as inside. So no ray passes between the
neighbours.

**Source.** Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
)";

constexpr Key keys[] = {
    {.name = "vertices",
     .type = KeyType::vec3_list,
     .doc = "The three corners, counter-clockwise seen from outside.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "normals",
     .type = KeyType::vec3_list,
     .doc = "Shading normals at the corners.",
     .optional = true},
    {.name = "uv",
     .type = KeyType::vec2_list,
     .doc = "Texture coordinates at the corners.",
     .min = -max_coordinate,
     .max = max_coordinate,
     .optional = true},
};

// The triangle in the world.
TriangleValues transformed(TriangleValues values, const Affine& map) {
  for (Vec3& vertex : values.vertices) vertex = map.point(vertex);
  if (values.normals) {
    const CornerNormals map_normal(map);
    for (Vec3& normal : *values.normals) normal = map_normal(unit(normal));
  }

  // A mirroring map reverses the winding. Reverse it back, and let every corner keep its own values.
  if (map.mirrors()) {
    if (!values.uv) values.uv = {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}};
    std::swap(values.vertices[1], values.vertices[2]);
    if (values.normals) std::swap((*values.normals)[1], (*values.normals)[2]);
    std::swap((*values.uv)[1], (*values.uv)[2]);
  }
  return values;
}

class Triangle final : public Shape {
 public:
  explicit Triangle(const TriangleValues& values)
      : vertices_(values.vertices),
        normals_(values.normals),
        uv_(values.uv),
        normal_(geometric_normal(vertices_)) {}

  std::optional<Intersection> intersect(const Ray& ray) const override {
    return intersect_triangle(vertices_, normal_, ray);
  }

  SurfacePoint surface(const Ray&, const Intersection& hit) const override {
    const auto& [v0, v1, v2] = vertices_;
    SurfacePoint point;
    point.position = v0 + (v1 - v0) * hit.u + (v2 - v0) * hit.v;
    // Move the point onto the plane from which t was computed: a sliver's normal is imprecise, and its
    // corners may lie off that plane.
    point.position -= normal_ * glm::dot(normal_, point.position - v0);
    point.position_error = 1e-13 * std::max({magnitude(v0), magnitude(v1), magnitude(v2)});
    point.normal_geometric = normal_;
    point.normal = normal_;
    set_edges(point, vertices_, hit);
    if (normals_) set_smooth(point, vertices_, *normals_, {1 - hit.u - hit.v, hit.u, hit.v});
    point.uv = uv_ ? interpolate(*uv_, hit) : Vec2(hit.u, hit.v);
    std::tie(point.along_u, point.along_v) = along_uv(vertices_, uv_.value_or(corner_weights));
    return point;
  }

  Bounds bounds() const override {
    Bounds bounds;
    for (const Vec3& vertex : vertices_) bounds.include(vertex);
    return bounds;
  }

  double thickness_margin() const override { return thickness(vertices_) / thinnest_triangle; }

  ShapeForm form() const override { return TriangleForm{vertices_}; }

  void pack(records::Packer& packer) const override {
    uint32_t attributes = NONE;
    const bool bends = packer.scene.bent_normals, has_uv = uv_ || bends;
    if (normals_ || has_uv) {
      const auto n = normals_.value_or(std::array<Vec3, 3>{normal_, normal_, normal_});
      const auto uv = uv_.value_or(bends ? corner_weights : std::array<Vec2, 3>{});
      const uint32_t first = packer.add_vertices({records::to_bits(records::to_vec4(n[0], uv[0].x)),
                                                  records::to_bits(records::to_vec4(n[1], uv[1].x)),
                                                  records::to_bits(records::to_vec4(n[2], uv[2].x))});
      attributes = packer.add_vertices({{first, first + 1, first + 2,
                                         (normals_ ? CORNERS_NORMALS : 0u) | (has_uv ? CORNERS_UV : 0u) |
                                             (bends ? CORNERS_GRADIENTS : 0u)},
                                        records::to_bits(records::to_vec4({uv[0].y, uv[1].y, uv[2].y}))});
      if (bends) {
        const UvGradients gradients = uv_gradients(vertices_, uv);
        packer.add_vertices({records::to_bits(records::to_vec4(gradients.u)),
                             records::to_bits(records::to_vec4(gradients.v))});
      }
    }
    // Remove −0, so that compiled-in triangles of one plane share its computed values.
    const Vec3 normal = normal_ + 0.0;
    packer.add(records::Packer::primitive(
        shader::KIND_triangle, material, records::to_vec4(packer.relative(vertices_[0]), normal.x),
        records::to_vec4(packer.relative(vertices_[1]), normal.y),
        records::to_vec4(packer.relative(vertices_[2]), normal.z), attributes));
  }

 private:
  template <typename T>
  static T interpolate(const std::array<T, 3>& values, const Intersection& hit) {
    return values[0] * (1 - hit.u - hit.v) + values[1] * hit.u + values[2] * hit.v;
  }

  Corners vertices_;
  std::optional<std::array<Vec3, 3>> normals_;
  std::optional<std::array<Vec2, 3>> uv_;
  Vec3 normal_;
};

// The three values of `list`, or an error at `key`.
template <typename T>
std::array<T, 3> three(TableReader& table, std::string_view key, const std::vector<T>& list) {
  if (list.size() != 3) {
    table.error(key, fmt::format("a triangle needs exactly 3, not {}", list.size()));
    return {};
  }
  return {list[0], list[1], list[2]};
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  TriangleValues values;
  const auto vertices = table.vec3_list("vertices");
  const auto normals = table.has("normals") ? table.vec3_list("normals") : std::vector<Vec3>();
  const auto uv = table.has("uv") ? table.vec2_list("uv") : std::vector<Vec2>();
  if (table.failed()) return nullptr;
  values.vertices = three(table, "vertices", vertices);
  if (table.has("normals")) values.normals = three(table, "normals", normals);
  if (table.has("uv")) values.uv = three(table, "uv", uv);
  if (table.failed()) return nullptr;

  // Check the triangle as it came, so that the message is at the key that is to blame, and then in the world.
  // Check the normals only as they came: they are interpolated in that space, whatever the transform.
  if (!(thickness(values.vertices) >= thinnest_triangle)) {
    table.error("vertices", "the triangle has no area: its vertices coincide or lie on one line");
  } else if (values.normals && std::count(values.normals->begin(), values.normals->end(), Vec3(0)) > 0) {
    table.error("normals", "a normal has no length");
  } else if (values.normals && std::ranges::any_of(*values.normals, [&](const Vec3& normal) {
               return glm::dot(unit(normal), geometric_normal(values.vertices)) <= least_normal_cosine;
             })) {
    table.error("normals",
                "a normal points to the inside: seen from outside, the vertices run counter-clockwise; "
                "reverse the normal, or swap two vertices");
  }
  if (table.failed()) return nullptr;
  const TriangleValues world = transformed(values, Affine(transform));
  for (const Vec3& vertex : world.vertices) {
    if (magnitude(vertex) <= max_coordinate) continue;
    table.error("transform", "the transformed vertices are out of range (coordinates up to 1e12)");
    return nullptr;
  }
  if (!(thickness(world.vertices) >= thinnest_triangle)) {
    table.error("transform", "the transform leaves the triangle without area");
    return nullptr;
  }
  return std::make_unique<Triangle>(world);
}

}  // namespace

extern const ShapeType triangle_type{
    .name = "triangle", .manual = manual, .keys = keys, .parse = parse, .flat = true};

std::unique_ptr<Shape> make_triangle(const TriangleValues& values, const Mat4& transform) {
  return std::make_unique<Triangle>(transformed(values, Affine(transform)));
}

}  // namespace eyeray::engine::shapes
