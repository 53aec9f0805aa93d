#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/bezier.hpp"
#include "host/shapes/bezier_clipping.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(A bicubic Bézier patch, Σ Bᵢ(v)·Bⱼ(u)·pᵢⱼ with Bernstein's polynomials B of degree 3. It is a smooth surface
that 16 control points attract. The corner points lie on it, and its edges are the Bézier curves of the outer
points. `points` are four rows of four: u runs along a row, v from row to row. The patch is not tessellated
into triangles. Open; the normal is that of ∂u × ∂v.

```toml
[[bezier]]
points = [
  [-1, 0, 1], [-0.3, 0.8, 1], [0.3, -0.8, 1], [1, 0, 1],
  [-1, 0.8, 0.3], [-0.3, 1.6, 0.3], [0.3, 0, 0.3], [1, 0.8, 0.3],
  [-1, -0.8, -0.3], [-0.3, 0, -0.3], [0.3, -1.6, -0.3], [1, -0.8, -0.3],
  [-1, 0, -1], [-0.3, 0.8, -1], [0.3, -0.8, -1], [1, 0, -1],
]
material = "wall"
```

One table holds several patches in a `batch = { points = [[…], […]] }`, such as Newell's 32 in
`scenes/shapes/include/gallery.toml`. An edge may collapse to a point, as on top of the teapot's lid. A patch
whose points all lie on one line is refused. `transform` may be any invertible affine map. Each crossing
multiplies the light of a shadow ray by √`shadow`, as for a mesh, because closed surfaces consist of many
patches.

**uv.** The u and v of the equation, from 0 to 1: (0, 0) at the first point, (1, 0) at the fourth, (0, 1) at
the thirteenth. A part of a texture that begins at 1, such as the next check, is not visible.

**Numeric trap.** Newton's method for u and v fails where a ray grazes the patch. There the two equations are
singular, and they may have several roots or none. So a patch is divided into pieces over which its
derivatives vary little, and each piece is one shape in the BVH. A plane through the ray and across a piece
cuts it in a curve along which u and v are never singular. The distance of the curve from the ray is followed
in short arcs. Each arc is so short that a cubic reliably shows how often the distance is zero.

**Source.** Martin, Cohen, Fish and Shirley: Practical Ray Tracing of Trimmed NURBS Surfaces, Journal of
Graphics Tools 5(1), 2000, for the pieces. The float64 implementation is Nishita, Sederberg and Kakimoto's
Bézier clipping.
)";

constexpr Key keys[] = {
    {.name = "points",
     .type = KeyType::vec3_list,
     .doc = "The 16 control points: four rows of four.",
     .min = -max_coordinate,
     .max = max_coordinate},
};

}  // namespace

double thickness(const BezierNet& net) {
  double longest = 0;
  Vec3 a(0.0), b(0.0);
  for (const Vec3& p : net)
    for (const Vec3& q : net) {
      if (glm::length(p - q) <= longest) continue;
      longest = glm::length(p - q);
      a = p;
      b = q;
    }
  if (longest == 0) return 0;
  double height = 0;
  for (const Vec3& p : net) height = std::max(height, glm::length(glm::cross((b - a) / longest, p - a)));
  return height / longest;
}

std::optional<Intersection> Bezier::intersect(const Ray& ray) const {
  return clip_bezier(net_, ray);
}

SurfacePoint Bezier::surface(const Ray&, const Intersection& hit) const {
  const BezierPoint at = bezier_point(net_, hit.u, hit.v);
  const Vec2 size = uv_.to - uv_.from;
  SurfacePoint surface;
  surface.position = at.position;
  surface.position_error = 0;
  for (const Vec3& p : net_) surface.position_error = std::max(surface.position_error, 1e-13 * magnitude(p));
  surface.normal_geometric = normal(at, {hit.u, hit.v}) * (mirrored_ ? -1.0 : 1.0);
  surface.normal = surface.normal_geometric;
  surface.uv = inner_uv(uv_.from + Vec2(hit.u, hit.v) * size);
  surface.along_u = at.along_u / size.x;
  surface.along_v = at.along_v / size.y;
  return surface;
}

Bounds Bezier::bounds() const {
  Bounds bounds;
  for (const Vec3& p : net_) bounds.include(p);
  return bounds;
}

void Bezier::pack_of(records::Packer& packer, int of_material) const {
  // The values that all pieces share.
  Bounds all = bounds();
  const Vec3 middle = (all.min + all.max) * 0.5;
  double radius = 0;
  for (const Vec3& p : net_) radius = std::max(radius, glm::length(p - middle));
  std::array<float, 48> numbers;
  for (size_t i = 0; i < 16; ++i) {
    const Vec3 p = packer.relative(net_[i]);
    for (int axis = 0; axis < 3; ++axis) numbers[3 * i + size_t(axis)] = float(p[axis]);
  }
  std::vector<shader::uvec4> words;
  for (size_t i = 0; i < 48; i += 4)
    words.push_back(records::to_bits({numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]}));
  words.push_back(records::to_bits(records::to_vec4(packer.relative(middle), radius)));
  const Vec2 uv = uv_.to - uv_.from;
  words.push_back(records::to_bits({float(uv_.from.x), float(uv_.from.y), float(uv.x), float(uv.y)}));
  const uint32_t extra = packer.add_vertices(words);

  for (const BezierPiece& piece : bezier_pieces(net_)) {
    // A hit may lie as far beyond a border as rounding moves it.
    const double room = 0x1p-18 * (magnitude(packer.relative(middle)) + radius);
    const auto& [from, to] = piece.range;
    // Iterations for both ends; for 24 arcs, each with its middle and its next end; for 4 roots.
    packer.add_iterations(2 * 4 + 24 * (1 + 4 + 4) + 4 * 40);
    packer.add_iteration_limit();
    packer.add_piece(records::Packer::primitive(
                         shader::KIND_bezier, of_material,
                         shader::vec4(float(from.x), float(to.x), float(from.y), float(to.y)),
                         records::to_vec4(packer.relative(piece.middle), piece.radius + room),
                         records::to_vec4(piece.normal, mirrored_ ? -piece.beyond : piece.beyond), extra),
                     {piece.bounds.min - room, piece.bounds.max + room});
  }
}

// The normal at a point. If the derivatives are parallel there, as where an edge is one point, the normal
// is that of a point next to it, towards the middle.
Vec3 Bezier::normal(const BezierPoint& at, const Vec2& uv) const {
  Vec3 n = glm::cross(at.along_u, at.along_v);
  const double size = glm::dot(at.along_u, at.along_u) + glm::dot(at.along_v, at.along_v);
  for (double step = 1e-6; !(glm::dot(n, n) > 1e-18 * size * size) && step < 1; step *= 10) {
    const BezierPoint near = bezier_point(net_, uv.x + (0.5 - uv.x) * step, uv.y + (0.5 - uv.y) * step);
    n = glm::cross(near.along_u, near.along_v);
    if (glm::dot(n, n) > 0) return unit(n);
  }
  return glm::dot(n, n) > 0 ? unit(n) : Vec3(0, 0, 1);
}

namespace {

BezierNet transformed(BezierNet net, const Affine& map) {
  for (Vec3& p : net) p = map.point(p);
  return net;
}

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const std::vector<Vec3> list = table.vec3_list("points");
  if (table.failed()) return nullptr;
  if (list.size() != 16) {
    table.error("points",
                fmt::format("a Bézier patch needs exactly 16 control points, four rows of four, not {}",
                            list.size()));
    return nullptr;
  }
  BezierNet net;
  std::copy(list.begin(), list.end(), net.begin());
  if (!(thickness(net) >= least_bezier_thickness)) {
    table.error("points", "the patch has no area: its control points coincide or lie on one line");
    return nullptr;
  }
  const BezierNet world = transformed(net, Affine(transform));
  for (const Vec3& p : world) {
    if (magnitude(p) <= max_coordinate) continue;
    table.error("transform", "the transformed control points are out of range (coordinates up to 1e12)");
    return nullptr;
  }
  if (!(thickness(world) >= least_bezier_thickness)) {
    table.error("transform", "the transform leaves the patch without area");
    return nullptr;
  }
  return make_bezier(net, transform);
}

}  // namespace

extern const ShapeType bezier_type{.name = "bezier", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_bezier(const std::array<Vec3, 16>& net, const Mat4& transform) {
  const Affine map(transform);
  return std::make_unique<Bezier>(transformed(net, map), map.mirrors());
}

}  // namespace eyeray::engine::shapes
