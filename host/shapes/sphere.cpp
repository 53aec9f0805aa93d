#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <numbers>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/object_shape.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/sphere_roots.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(All points at the distance `radius` from `center`: |x − center| = radius. Closed; the normal points outward.

```toml
[[sphere]]
center = [0, 1, 0]
radius = 1
material = "glass"
```

`transform` may be any invertible affine map. A map that stretches or shears turns the sphere into an
[ellipsoid](#ellipsoid) with the same uv.

**uv.** In the sphere's own axes (rotated by `transform`), with n the unit vector from the centre: the pole is
+y. `v = atan2(√(n.x² + n.z²), −n.y) / π` runs from 0 at the south pole to 1 at the north pole.
`u = 0.5 + atan2(−n.z, n.x) / 2π`, with 1 replaced by 0, runs eastward (counter-clockwise seen from the north
pole). It starts at the seam at −x and runs over +z (¼) and +x (½) to −z (¾).

**Numeric trap.** The textbook discriminant b² − 4ac subtracts two large, nearly equal numbers for a small or
distant sphere. Here the discriminant is computed from the distance between the centre and the ray, r² − |f +
(b/a)·d|². The roots are q/a and c/q, which never cancel. The hit is then moved back onto the sphere.

**Source.** Haines, Günther, Akenine-Möller: Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems,
chapter 7, 2019.
)";

constexpr Key keys[] = {
    center_key,
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Distance of the surface from the centre.",
     .min = min_radius,
     .max = max_coordinate},
};

class Sphere final : public Shape {
 public:
  Sphere(const Vec3& center, double radius, const Mat3& axes)
      : center_(center), radius_(radius), axes_(axes) {}

  std::optional<Intersection> intersect(const Ray& ray) const override {
    const auto span = inside(ray);
    if (!span) return std::nullopt;
    const Intersection& hit = span->in.t > 0 ? span->in : span->out;
    if (!(hit.t > 0) || !std::isfinite(hit.t)) return std::nullopt;
    return hit;
  }

  bool is_closed() const override { return true; }

  std::vector<Span> spans(const Ray& ray) const override {
    const auto span = inside(ray);
    if (!span || !(span->in.t < span->out.t)) return {};
    return {*span};
  }

  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    const Vec3 normal = unit((ray.o - center_) + ray.d * hit.t);
    const double error = 1e-13 * (magnitude(center_) + radius_);
    const Vec3 own = normal * axes_;
    return {center_ + normal * radius_,
            error,
            normal,
            normal,
            uv(own),
            axes_ * along_turn(own) * radius_,
            axes_ * along_meridian(own) * radius_};
  }

  Bounds bounds() const override { return {center_ - Vec3(radius_), center_ + Vec3(radius_)}; }

  ShapeForm form() const override { return SphereForm{center_, radius_, axes_}; }

  void pack(records::Packer& packer) const override {
    const bool mirrored = glm::determinant(axes_) < 0;
    packer.add(records::Packer::primitive(
        shader::KIND_sphere, material, records::to_vec4(packer.relative(center_), radius_),
        records::to_vec4(axes_[1]), records::to_vec4(axes_[0], mirrored ? -1 : 1)));
  }

 private:
  // The span of the line within the sphere.
  std::optional<Span> inside(const Ray& ray) const {
    const auto roots = sphere_roots(center_, radius_, ray);
    if (!roots) return std::nullopt;
    return Span{{roots->first, 0, 0}, {roots->second, 0, 0}};
  }

  // The uv on the map of a direction from the centre, in the sphere's own axes.
  static Vec2 uv(const Vec3& n) {
    const double u = 0.5 + std::atan2(-n.z, n.x) / (2 * std::numbers::pi);
    const double v = std::atan2(std::hypot(n.x, n.z), -n.y) / std::numbers::pi;
    return {u < 1 ? u : 0, v};
  }

  Vec3 center_;
  double radius_;
  Mat3 axes_;  // its own x, y (the pole), z in the world: orthonormal, left-handed under a mirror
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  const Vec3 center = table.vec3("center");
  const double radius = table.number("radius");
  if (table.failed()) return nullptr;
  const auto map = similarity(transform);
  if (!map && out_of_range(table, glm::scale(glm::translate(transform, center), Vec3(radius))))
    return nullptr;
  if (map && !(radius * map->scale >= min_radius && magnitude(map->point(center)) <= max_coordinate &&
               radius * map->scale <= max_coordinate)) {
    table.error("transform",
                "the transformed sphere is out of range (radius 1e-12 to 1e12, centre up to 1e12)");
    return nullptr;
  }
  return make_sphere(center, radius, transform);
}

}  // namespace

extern const ShapeType sphere_type{.name = "sphere", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Shape> make_sphere(const Vec3& center, double radius, const Mat4& transform) {
  const auto map = similarity(transform);
  if (!map) return make_ellipsoid(center, Vec3(radius), transform);
  return std::make_unique<Sphere>(map->point(center), radius * map->scale, map->axes);
}

}  // namespace eyeray::engine::shapes
