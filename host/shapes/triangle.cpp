#include <algorithm>
#include <cmath>
#include <utility>

#include "records/packer.hpp"
#include "shapes/affine.hpp"
#include "shapes/make.hpp"

namespace eyeray {

namespace {

constexpr std::string_view manual =
    R"(The flat piece between three vertices: x = w₀·v₀ + w₁·v₁ + w₂·v₂ with weights ≥ 0 that sum to 1, edges included.
The normal points to where the vertices run counter-clockwise.

```toml
[[triangle]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
uv = [[0, 0], [1, 0], [0, 1]]
material = "wall"
```

`transform` may be any affine map that can be undone. Under one that mirrors, the outside stays outside. A closed mesh of a
dielectric needs all its normals outward: in and out of the glass is decided by them.

**normals** (three, of any length but 0, each on the side of the geometric normal) are interpolated for shading.
**uv** (three) are interpolated for textures; without them u and v are the weights of the second and third vertex.

**Numeric trap.** Methods that compare barycentrics with 0 after a division (Möller–Trumbore) let rays through between two
neighbours: one in ten of those aimed at an edge. Here the vertices are sheared into the plane across the ray, alike for
all triangles, and the signs of the three edge functions a·d − b·c decide: they are exact or zero, for both neighbours, and zero counts as
inside. So a ray never passes between them.

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

// Twice the area over the square of the longest edge; a thinner triangle has no usable normal.
constexpr double thinnest = 1e-9;

double thickness(const std::array<Vec3, 3>& v) {
  const double size = std::max({magnitude(v[1] - v[0]), magnitude(v[2] - v[1]), magnitude(v[0] - v[2])});
  if (!(size > 0)) return 0;
  return glm::length(glm::cross((v[1] - v[0]) / size, (v[2] - v[0]) / size));
}

// Unit, by counter-clockwise winding.
Vec3 geometric_normal(const std::array<Vec3, 3>& v) {
  const double size = magnitude(v[1] - v[0]);
  return unit(glm::cross((v[1] - v[0]) / size, (v[2] - v[0]) / size));
}

// The triangle in the world, its normals unit.
TriangleValues transformed(TriangleValues values, const Affine& map) {
  for (Vec3& vertex : values.vertices) vertex = map.point(vertex);
  if (values.normals)
    for (Vec3& normal : *values.normals) normal = map.normal(unit(normal));

  // A mirror turns the winding round; turn it back, and let every corner keep what is its own.
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
    // Shear the vertices along the ray into the plane across its main axis z.
    const Vec3 size = glm::abs(ray.d);
    const int z = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int x = (z + 1) % 3;
    const int y = (z + 2) % 3;
    std::array<Vec2, 3> p;
    for (size_t i = 0; i < 3; ++i) {
      const Vec3 from_eye = vertices_[i] - ray.o;
      p[i] = {from_eye[x] - ray.d[x] / ray.d[z] * from_eye[z],
              from_eye[y] - ray.d[y] / ray.d[z] * from_eye[z]};
    }

    // Ask on which side of each edge the ray passes.
    const double w0 = edge(p[1], p[2]);
    const double w1 = edge(p[2], p[0]);
    const double w2 = edge(p[0], p[1]);
    if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return std::nullopt;
    const double area = w0 + w1 + w2;
    if (area == 0) return std::nullopt;

    // The plane gives t, to the same bit for all that lies in one axis-aligned plane.
    const double t = glm::dot(normal_, vertices_[0] - ray.o) / glm::dot(normal_, ray.d);
    if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
    return Intersection{t, w1 / area, w2 / area};
  }

  SurfacePoint surface(const Ray&, const Intersection& hit) const override {
    const auto& [v0, v1, v2] = vertices_;
    SurfacePoint point;
    point.position = v0 + (v1 - v0) * hit.u + (v2 - v0) * hit.v;
    point.position_error = 1e-13 * std::max({magnitude(v0), magnitude(v1), magnitude(v2)});
    point.normal_geometric = normal_;
    point.normal = normals_ ? unit(interpolate(*normals_, hit)) : normal_;
    point.uv = uv_ ? interpolate(*uv_, hit) : Vec2(hit.u, hit.v);
    return point;
  }

  Bounds bounds() const override {
    Bounds bounds;
    for (const Vec3& vertex : vertices_) bounds.include(vertex);
    return bounds;
  }

  ShapeForm form() const override { return TriangleForm{vertices_}; }

  void pack(Packer& packer) const override {
    uint32_t attributes = NONE;
    if (normals_ || uv_) {
      const auto n = normals_.value_or(std::array<Vec3, 3>{normal_, normal_, normal_});
      const auto uv = uv_.value_or(std::array<Vec2, 3>{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)});
      attributes = packer.add_vertices({to_vec4(n[0], uv[0].x), to_vec4(n[1], uv[1].x),
                                        to_vec4(n[2], uv[2].x), to_vec4({uv[0].y, uv[1].y, uv[2].y})});
    }
    packer.add({.head = {shader::KIND_triangle, uint32_t(material), 0u, attributes},
                .a = to_vec4(packer.relative(vertices_[0]), normal_.x),
                .b = to_vec4(packer.relative(vertices_[1]), normal_.y),
                .c = to_vec4(packer.relative(vertices_[2]), normal_.z)});
  }

 private:
  // Swapped ends give exactly the negative.
  static double edge(const Vec2& from, const Vec2& to) { return from.x * to.y - from.y * to.x; }

  template <typename T>
  static T interpolate(const std::array<T, 3>& values, const Intersection& hit) {
    return values[0] * (1 - hit.u - hit.v) + values[1] * hit.u + values[2] * hit.v;
  }

  std::array<Vec3, 3> vertices_;
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
  if (!(thickness(values.vertices) >= thinnest)) {
    table.error("vertices", "the triangle has no area: its vertices coincide or lie on one line");
  } else if (values.normals && std::count(values.normals->begin(), values.normals->end(), Vec3(0)) > 0) {
    table.error("normals", "a normal has no length");
  }
  if (table.failed()) return nullptr;
  const TriangleValues world = transformed(values, Affine(transform));
  for (const Vec3& vertex : world.vertices) {
    if (magnitude(vertex) <= max_coordinate) continue;
    table.error("transform", "the transformed vertices are out of range (coordinates up to 1e12)");
    return nullptr;
  }
  if (!(thickness(world.vertices) >= thinnest)) {
    table.error("transform", "the map leaves the triangle no area");
    return nullptr;
  }
  if (world.normals) {
    const Vec3 geometric = geometric_normal(world.vertices);
    for (const Vec3& normal : *world.normals) {
      if (glm::dot(normal, geometric) > 1e-6) continue;
      table.error("normals",
                  "a normal points away from the outside, which is where the vertices run counter-clockwise; "
                  "turn it, or "
                  "swap two vertices");
      return nullptr;
    }
  }
  return std::make_unique<Triangle>(world);
}

}  // namespace

extern const ShapeType triangle_type{.name = "triangle", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_triangle(const TriangleValues& values, const Mat4& transform) {
  return std::make_unique<Triangle>(transformed(values, Affine(transform)));
}

}  // namespace eyeray
