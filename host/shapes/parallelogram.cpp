#include <algorithm>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/scene/triangle.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points origin + u·edge_u + v·edge_v with u and v from 0 to 1. If the edges are perpendicular, it is a
rectangle. The normal points in the direction of edge_u × edge_v.

```toml
[[parallelogram]]
origin = [0, 0, 0]
edge_u = [2, 0, 0]
edge_v = [0.5, 1, 0]
material = "wall"
```

`transform` may be any invertible affine map. Under a mirroring map the outside stays outside. Closed bodies
of parallelograms are watertight where they share vertices, also with triangles and polygons.

**uv.** u grows from 0 at the origin to 1 along `edge_u`, v along `edge_v`.

**Numeric trap.** Solving for u and v and comparing them with 0 and 1 lets rays through between two
neighbours. Here the signs of four edge functions decide, as for polygons.

**Source.** As for polygons.
)";

constexpr Key keys[] = {
    {.name = "origin",
     .type = KeyType::vec3,
     .doc = "The corner where u and v are 0.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "edge_u",
     .type = KeyType::vec3,
     .doc = "Vector from the origin to the corner where u is 1.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "edge_v",
     .type = KeyType::vec3,
     .doc = "Vector from the origin to the corner where v is 1.",
     .min = -max_coordinate,
     .max = max_coordinate},
};

class Parallelogram final : public Shape {
 public:
  Parallelogram(const Vec3& origin, const Vec3& edge_u, const Vec3& edge_v, const Vec3& normal)
      : origin_(origin), edge_u_(edge_u), edge_v_(edge_v), normal_(normal) {}

  // The parallelogram is two triangles, which share the diagonal to the last bit.
  std::optional<Intersection> intersect(const Ray& ray) const override {
    const Vec3 b = origin_ + edge_u_, c = origin_ + edge_v_, d = origin_ + edge_u_ + edge_v_;
    if (const auto hit = intersect_triangle({origin_, b, c}, normal_, ray)) return hit;
    if (const auto hit = intersect_triangle({d, c, b}, normal_, ray))
      return Intersection{hit->t, 1 - hit->u, 1 - hit->v};
    return std::nullopt;
  }

  SurfacePoint surface(const Ray&, const Intersection& hit) const override {
    const double error = 1e-13 * (magnitude(origin_) + magnitude(edge_u_) + magnitude(edge_v_));
    Vec3 from_origin = edge_u_ * hit.u + edge_v_ * hit.v;
    from_origin -= normal_ * glm::dot(normal_, from_origin);
    return {origin_ + from_origin, error, normal_, normal_, inner_uv({hit.u, hit.v}), edge_u_, edge_v_};
  }

  Bounds bounds() const override {
    Bounds bounds;
    for (const double u : {0, 1})
      for (const double v : {0, 1}) bounds.include(origin_ + edge_u_ * u + edge_v_ * v);
    return bounds;
  }

  double thickness_margin() const override {
    return thickness({Vec3(0), unit(edge_u_), unit(edge_v_)}) / thinnest_triangle;
  }

  ShapeForm form() const override {
    return PolygonForm{{{origin_, origin_ + edge_u_, origin_ + edge_u_ + edge_v_, origin_ + edge_v_}}};
  }

  void pack(records::Packer& packer) const override {
    const Vec3 origin = packer.relative(origin_);
    const uint32_t opposite =
        packer.add_vertices({records::to_bits(records::to_vec4(origin + edge_u_ + edge_v_))});
    packer.add(records::Packer::primitive(shader::KIND_parallelogram, material,
                                          records::to_vec4(origin, normal_.x),
                                          records::to_vec4(origin + edge_u_, normal_.y),
                                          records::to_vec4(origin + edge_v_, normal_.z), opposite));
  }

 private:
  Vec3 origin_;
  Vec3 edge_u_;
  Vec3 edge_v_;
  Vec3 normal_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 origin = table.vec3("origin");
  const Vec3 edge_u = table.vec3("edge_u");
  const Vec3 edge_v = table.vec3("edge_v");
  if (table.failed()) return nullptr;
  if (edge_u == Vec3(0) || edge_v == Vec3(0)) {
    table.error(edge_u == Vec3(0) ? "edge_u" : "edge_v", "the edge has no length");
    return nullptr;
  }
  const auto thin = [](const Vec3& u, const Vec3& v) {
    return thickness({Vec3(0), unit(u), unit(v)}) < thinnest_triangle;
  };
  if (thin(edge_u, edge_v)) {
    table.error("edge_v", "the parallelogram has no area: its edges are parallel");
    return nullptr;
  }
  const Affine map(transform);
  const Vec3 u = map.linear * edge_u, v = map.linear * edge_v;
  if (!(magnitude(map.point(origin)) + magnitude(u) + magnitude(v) <= max_coordinate)) {
    table.error("transform", "the transformed corners are out of range (coordinates up to 1e12)");
    return nullptr;
  }
  if (thin(u, v)) {
    table.error("transform", "the transform leaves the parallelogram without area");
    return nullptr;
  }
  return make_parallelogram(origin, edge_u, edge_v, transform);
}

}  // namespace

extern const ShapeType parallelogram_type{
    .name = "parallelogram", .manual = manual, .keys = keys, .parse = parse, .flat = true};

std::unique_ptr<Shape> make_parallelogram(const Vec3& origin, const Vec3& edge_u, const Vec3& edge_v,
                                          const Mat4& transform) {
  const Affine map(transform);
  const Vec3 normal = unit(glm::cross(unit(edge_u), unit(edge_v)));
  return std::make_unique<Parallelogram>(map.point(origin), map.linear * edge_u, map.linear * edge_v,
                                         map.normal(normal));
}

}  // namespace eyeray::engine::shapes
