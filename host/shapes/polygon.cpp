#include <algorithm>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/plane_axes.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(The flat area within an outline, convex or not, minus its holes. A point of the plane belongs to it if a half
line from there, in the plane, crosses the edges an odd number of times. The normal points to the side from
which the vertices run counter-clockwise.

```toml
[[polygon]]
vertices = [[0, 0, 0], [4, 0, 0], [4, 3, 0], [2, 1, 0], [0, 3, 0]]
holes = [[[0.5, 0.5, 0], [1, 0.5, 0], [1, 1, 0]], [[3, 0.5, 0], [3.5, 0.5, 0], [3.5, 1, 0]]]
material = "wall"
```

`transform` may be any invertible affine map. Under a mirroring map the outside stays outside. Holes may run
in either direction. Outlines must be flat (to 1e-5 of their size), and must neither cross nor touch
themselves or each other. All of them together have at most 16384 vertices. Closed bodies of polygons are
watertight where they share vertices, also with triangles and parallelograms.

**uv.** Distances from the first vertex along two axes U and V in the plane, with (U, V, normal) right-handed.
U is `u_axis` projected onto the plane. Without `u_axis`, U is that of a plane. uv are in the polygon's own
units, before `transform`.

**Numeric trap.** The edges that a half line crosses are undecided where it hits a vertex. Two neighbours that
compute the same edge differently may both decide against a point on it. Here the vertices are sheared into
the plane perpendicular to the ray, in the same way for all shapes. One test for each vertex decides whether
it is above the ray, where 0 counts as below. The side of an edge is the sign of a·d − b·c, which is exactly
negated for the other direction of the edge. So neighbours agree to the last bit, and a point within both
together is within exactly one of them.

**Source.** Shimrat: Algorithm 112, Position of Point Relative to Polygon, CACM 5(8), 1962; Haines: Point in Polygon Strategies, Graphics Gems IV,
1994; the shear after Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
)";

constexpr Key keys[] = {
    vertices_key,
    holes_key,
    {.name = "u_axis",
     .type = KeyType::vec3,
     .doc = "Direction along which u grows, projected onto the plane.",
     .optional = true},
};

class Polygon final : public Shape {
 public:
  // All arguments are in the world; the gradients of u and v lie in the plane.
  Polygon(PlanarRegion region, const Vec3& normal, const Vec3& u_gradient, const Vec3& v_gradient)
      : region_(std::move(region)), normal_(normal), u_gradient_(u_gradient), v_gradient_(v_gradient) {}

  std::optional<Intersection> intersect(const Ray& ray) const override {
    const double t = glm::dot(normal_, origin() - ray.o) / glm::dot(normal_, ray.d);
    if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
    bool inside = is_within(region_.outer, ray);
    for (const Outline& hole : region_.holes) inside = inside != is_within(hole, ray);
    if (!inside) return std::nullopt;
    return Intersection{t, 0, 0};
  }

  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    const Vec3 from_origin = tangential((ray.o - origin()) + ray.d * hit.t, normal_);
    const double error = 1e-13 * (magnitude(origin()) + magnitude(from_origin));
    const Vec2 uv(glm::dot(u_gradient_, from_origin), glm::dot(v_gradient_, from_origin));
    SurfacePoint surface{origin() + from_origin, error, normal_, normal_, uv};
    set_along(surface, u_gradient_, v_gradient_);
    return surface;
  }

  Bounds bounds() const override {
    Bounds bounds;
    for (const Vec3& vertex : region_.outer) bounds.include(vertex);
    return bounds;
  }

  ShapeForm form() const override {
    PolygonForm form{{region_.outer}};
    for (const Outline& hole : region_.holes) form.outlines.push_back(hole);
    return form;
  }

  double thickness_margin() const override { return region_.thickness() / thinnest_region; }

  void pack(records::Packer& packer) const override {
    const Vec3 first = packer.relative(origin());
    std::vector<shader::uvec4> vertices = {
        records::to_bits(records::to_vec4(u_gradient_, -glm::dot(u_gradient_, first))),
        records::to_bits(records::to_vec4(v_gradient_, -glm::dot(v_gradient_, first)))};
    const size_t path_begin = vertices.size();
    const auto go_to = [&](const Vec3& vertex, bool along_edge = false) {
      vertices.push_back(records::to_bits(records::to_vec4(packer.relative(vertex), along_edge)));
    };
    // Goes round an outline with the polygon to the left.
    const auto go_round = [&](const Outline& outline, const Vec3& up) {
      const bool as_given = glm::dot(area_of(outline), up) > 0;
      const size_t n = outline.size();
      go_to(outline[0]);
      for (size_t i = 1; i <= n; ++i) go_to(outline[as_given ? i % n : n - i], true);
    };
    go_round(region_.outer, normal_);
    for (const Outline& hole : region_.holes) {
      go_round(hole, -normal_);
      go_to(origin());
    }
    while ((vertices.size() - path_begin - 1) % 4 != 0) go_to(origin());

    // The bounds around the rounded vertices, relative to a point of the plane.
    const auto rounded = [&](size_t i) { return Vec3(std::bit_cast<shader::vec4>(vertices[i])); };
    Bounds box;
    for (size_t i = path_begin; i < vertices.size(); ++i) box.include(rounded(i));
    const Vec3 middle = (box.min + box.max) * 0.5;
    const Vec3 centre = Vec3(glm::vec3(first + tangential(middle - first, normal_)));
    const Vec3 reach = glm::max(box.max - centre, centre - box.min);

    const size_t turns = (vertices.size() - path_begin - 1) / 4;
    packer.add_iterations(turns);
    packer.add(records::Packer::primitive(
        shader::KIND_polygon, material, records::to_vec4(normal_, double(turns)), records::to_vec4(centre),
        records::to_vec4(reach * (1 + 0x1p-23)), packer.add_vertices(vertices)));
  }

 private:
  const Vec3& origin() const { return region_.outer[0]; }

  // True if the outline winds around the ray's line. The outline is sheared along the ray into the plane
  // across the ray's main axis z, as in intersect_triangle, so that neighbours agree on their edges.
  static bool is_within(const Outline& outline, const Ray& ray) {
    const Vec3 size = glm::abs(ray.d);
    const int z = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int x = (z + 1) % 3;
    const int y = (z + 2) % 3;
    std::vector<Vec2> flat;
    flat.reserve(outline.size());
    for (const Vec3& vertex : outline) {
      const Vec3 p = vertex - ray.o;
      flat.emplace_back(p[x] - ray.d[x] / ray.d[z] * p[z], p[y] - ray.d[y] / ray.d[z] * p[z]);
    }
    return winding(flat, Vec2(0)) != 0;
  }

  PlanarRegion region_;
  Vec3 normal_;
  Vec3 u_gradient_;  // u = u_gradient · (x − origin)
  Vec3 v_gradient_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const auto region = read_region(table);
  std::optional<Vec3> u_axis;
  if (table.has("u_axis")) u_axis = table.vec3("u_axis");
  if (table.failed() || !region) return nullptr;
  if (u_axis) {
    const std::string why = why_no_u_axis(region->normal(), *u_axis);
    if (!why.empty()) {
      table.error("u_axis", why);
      return nullptr;
    }
  }
  if (const std::string why = why_out_of_range(region->transformed(Affine(transform))); !why.empty()) {
    table.error("transform", why);
    return nullptr;
  }
  return make_polygon(*region, transform, u_axis);
}

}  // namespace

extern const ShapeType polygon_type{
    .name = "polygon", .manual = manual, .keys = keys, .parse = parse, .flat = true};

std::unique_ptr<Shape> make_polygon(const PlanarRegion& region, const Mat4& transform,
                                    const std::optional<Vec3>& u_axis) {
  // Lay the axes in the polygon's own space, where uv are distances; gradients map as normals do, but keep
  // their length.
  const Affine map(transform);
  const Vec3 normal = region.normal();
  const auto [u, v] = plane_axes(normal, u_axis);
  const Vec3 world_normal = map.normal(normal);
  return std::make_unique<Polygon>(region.transformed(map), world_normal,
                                   tangential(map.cotangent * u, world_normal),
                                   tangential(map.cotangent * v, world_normal));
}

}  // namespace eyeray::engine::shapes
