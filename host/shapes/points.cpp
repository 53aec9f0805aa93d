#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/shapes/keys.hpp"
#include "host/shapes/make.hpp"
#include "host/shapes/pieces.hpp"
#include "host/shapes/registry.hpp"
#include "host/shapes/sphere_roots.hpp"

namespace eyeray::engine::shapes {

namespace {

constexpr std::string_view manual =
    R"(Spheres of one `radius` around many points c: |x − c| = radius. They are one object, with one id, however
many points it has. A file of points is shown by [[mesh]](#mesh).

```toml
[[points]]
points = [[-1, 1, 0], [0, 1, 0], [1, 1, 0]]
colors = [[1, 0.2, 0.1], [0.2, 1, 0.1], [0.1, 0.2, 1]]
radius = 0.5
material = "wall"
```

The colors multiply `diffuse`, `ambient` and `emission` of the material, as those of a mesh's vertices do.
`transform` may rotate, move, mirror and scale evenly. The spheres may overlap, so the material must be opaque:
light cannot pass through it, and it has no cutouts. **uv** are 0.

**Numeric trap.** The intersection is that of [a sphere](#sphere). Where two spheres intersect, a ray may hit
both at the same t in float32. It then hits the point that is earlier in the list, so that the hit does not depend
on the order of the search.
)";

constexpr Key keys[] = {
    {.name = "points",
     .type = KeyType::vec3_list,
     .doc = "Centres of the spheres.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Radius of all spheres.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "colors",
     .type = KeyType::vec3_list,
     .doc = "A color for each point, linear RGB. When absent: white.",
     .min = 0,
     .max = 1,
     .optional = true},
};

class Points final : public Shape {
 public:
  Points(std::shared_ptr<const PointCloud> cloud, double radius, const Similarity& map)
      : cloud_(std::move(cloud)), radius_(radius * map.scale), map_(map) {
    for (const Vec3& p : cloud_->positions) bounds_.include(map_.point(p));
    bounds_ = {bounds_.min - radius_, bounds_.max + radius_};
    search_.emplace(
        cloud_->positions.size(),
        [this](uint32_t i) {
          const Vec3 at = center(i);
          return Bounds{at - radius_, at + radius_};
        },
        bounds_);
  }

  std::optional<Intersection> intersect(const Ray& ray) const override {
    return search_->nearest(ray, [&](uint32_t i) -> std::optional<Intersection> {
      const auto roots = sphere_roots(center(i), radius_, ray);
      if (!roots) return std::nullopt;
      const double t = roots->first > 0 ? roots->first : roots->second;
      if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
      return Intersection{.t = t};
    });
  }

  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    const Vec3 at = center(hit.part);
    const Vec3 normal = unit((ray.o - at) + ray.d * hit.t);
    SurfacePoint point{.position = at + normal * radius_,
                       .position_error = 1e-13 * (magnitude(at) + radius_),
                       .normal_geometric = normal,
                       .normal = normal,
                       .uv = Vec2(0.0)};
    if (!cloud_->colors.empty()) point.color = Vec3(cloud_->colors[hit.part]);
    return point;
  }

  Bounds bounds() const override { return bounds_; }

  // It does not fit under a map that stretches, so a group that has it is read once more for each map.
  double thickness_margin() const override { return 0; }

  void pack(records::Packer& packer) const override {
    const size_t count = cloud_->positions.size();
    packer.reserve_pieces(count);
    packer.scene.own_colors = packer.scene.own_colors || !cloud_->colors.empty();
    for (size_t i = 0; i < count; ++i) {
      const Vec3 at = center(i);
      const Vec3 color = cloud_->colors.empty() ? Vec3(1.0) : Vec3(cloud_->colors[i]);
      const auto number = double(i & 0xffffff);  // as much of it as a float holds
      packer.add_piece(records::Packer::primitive(shader::KIND_points, material,
                                                  records::to_vec4(packer.relative(at), radius_),
                                                  records::to_vec4(color, number), shader::vec4(0.0f)),
                       {at - radius_, at + radius_});
    }
  }

 private:
  Vec3 center(size_t i) const { return map_.point(cloud_->positions[i]); }

  std::shared_ptr<const PointCloud> cloud_;
  double radius_;
  Similarity map_;  // cloud to world
  Bounds bounds_;
  std::optional<PieceSearch> search_;
};

std::unique_ptr<Shape> parse(TableReader& table, const Mat4& transform) {
  auto cloud = std::make_shared<PointCloud>();
  cloud->positions = table.vec3_list("points");
  if (table.valid("points") && cloud->positions.empty())
    table.error("points", "there must be a point at least");
  if (table.has("colors") && table.valid("colors") && table.valid("points")) {
    const std::vector<Vec3> colors = table.vec3_list("colors");
    if (colors.size() != cloud->positions.size())
      table.error("colors", fmt::format("there are {} points and {} colors; each point needs one",
                                        cloud->positions.size(), colors.size()));
    cloud->colors.assign(colors.begin(), colors.end());
  }
  if (table.failed()) return nullptr;
  cloud->radius = table.number("radius");
  std::unique_ptr<Shape> points = make_points(cloud, cloud->radius, transform);
  if (!points)
    table.error("transform", similarity(transform)
                                 ? "the transformed points are out of range (coordinates up to 1e12)"
                                 : "points cannot be sheared or scaled unevenly");
  return points;
}

}  // namespace

extern const ShapeType points_type{
    .name = "points", .manual = manual, .keys = keys, .parse = parse, .overlaps = true};

std::unique_ptr<Shape> make_points(std::shared_ptr<const PointCloud> cloud, double radius,
                                   const Mat4& transform) {
  const auto map = similarity(transform);
  if (!map) return nullptr;
  auto points = std::make_unique<Points>(std::move(cloud), radius, *map);
  const Bounds bounds = points->bounds();
  const bool in_range = std::max(magnitude(bounds.min), magnitude(bounds.max)) <= max_coordinate;
  return in_range && radius * map->scale >= min_radius ? std::move(points) : nullptr;
}

}  // namespace eyeray::engine::shapes
