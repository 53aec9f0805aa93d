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

With `normals` the points are disks: (x − c) · n = 0 and |x − c| ≤ radius. A disk is a sheet without an inside, and both
of its sides are shaded.

```toml
[[points]]
points = [[-1, 1, 0], [0, 1, 0], [1, 1, 0]]
colors = [[1, 0.2, 0.1], [0.2, 1, 0.1], [0.1, 0.2, 1]]
radius = 0.5
material = "wall"
```

The colors multiply `diffuse`, `ambient` and `emission` of the material, as those of a mesh's vertices do.
`transform` may rotate, move, mirror and scale evenly. The points may overlap, so the material must be opaque:
light cannot pass through it, and it has no cutouts. **uv** are 0.

**Numeric trap.** The intersection is that of [a sphere](#sphere), or of a plane, computed from the point of the ray that
is nearest to c, as that of [a disk](#disk) is. Where two points intersect, a ray may hit
both at the same t in float32. It then hits the point that is earlier in the list, so that the hit does not depend
on the order of the search.
)";

constexpr Key keys[] = {
    {.name = "points",
     .type = KeyType::vec3_list,
     .doc = "Centres of the spheres or disks.",
     .min = -max_coordinate,
     .max = max_coordinate},
    {.name = "radius",
     .type = KeyType::number,
     .doc = "Radius of all spheres or disks.",
     .min = min_radius,
     .max = max_coordinate},
    {.name = "colors",
     .type = KeyType::vec3_list,
     .doc = "A color for each point, linear RGB. When absent: white.",
     .min = 0,
     .max = 1,
     .optional = true},
    {.name = "normals",
     .type = KeyType::vec3_list,
     .doc =
         "A vector perpendicular to the disk of each point, of any length but 0. When absent, the points are "
         "spheres.",
     .min = -max_coordinate,
     .max = max_coordinate,
     .optional = true},
};

// The t at which a line hits the disk around `center` that is perpendicular to the unit vector `normal`;
// empty if it misses.
std::optional<double> disk_root(const Vec3& center, const Vec3& normal, double radius, const Ray& ray) {
  const Vec3 f = ray.o - center;
  const double start = -glm::dot(f, ray.d) / glm::dot(ray.d, ray.d);
  const Vec3 nearest = f + ray.d * start;
  const double t = -glm::dot(normal, nearest) / glm::dot(normal, ray.d);
  const Vec3 from_center = nearest + ray.d * t;
  if (!(glm::dot(from_center, from_center) <= radius * radius)) return std::nullopt;
  return start + t;
}

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
      const std::optional<double> t = root(i, ray);
      if (!t || !(*t > 0) || !std::isfinite(*t)) return std::nullopt;
      return Intersection{.t = *t};
    });
  }

  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override {
    const Vec3 at = center(hit.part), from_center = (ray.o - at) + ray.d * hit.t;
    const bool disk = is_disk(hit.part);
    const Vec3 normal = disk ? disk_normal(hit.part) : unit(from_center);
    const Vec3 offset = disk ? from_center - normal * glm::dot(normal, from_center) : normal * radius_;
    SurfacePoint point{.position = at + offset,
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
      const bool disk = is_disk(i);
      packer.add_piece(records::Packer::primitive(
                           shader::KIND_points, material, records::to_vec4(packer.relative(at), radius_),
                           records::to_vec4(color, number),
                           records::to_vec4(disk ? disk_normal(i) : Vec3(0.0), disk ? 1.0 : 0.0)),
                       {at - radius_, at + radius_});
    }
  }

 private:
  Vec3 center(size_t i) const { return map_.point(cloud_->positions[i]); }
  bool is_disk(size_t i) const { return !cloud_->normals.empty() && cloud_->normals[i] != glm::vec3(0.0f); }
  Vec3 disk_normal(size_t i) const { return unit(map_.axes * Vec3(cloud_->normals[i])); }
  // The t of the hit of point i; 0 or less if it lies behind the ray.
  std::optional<double> root(size_t i, const Ray& ray) const {
    if (is_disk(i)) return disk_root(center(i), disk_normal(i), radius_, ray);
    const auto roots = sphere_roots(center(i), radius_, ray);
    if (!roots) return std::nullopt;
    return roots->first > 0 ? roots->first : roots->second;
  }

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
  if (table.has("normals") && table.valid("normals") && table.valid("points")) {
    const std::vector<Vec3> normals = table.vec3_list("normals");
    if (normals.size() != cloud->positions.size())
      table.error("normals", fmt::format("there are {} points and {} normals; each point needs one",
                                         cloud->positions.size(), normals.size()));
    for (size_t i = 0; i < normals.size(); ++i) {
      if (normals[i] == Vec3(0.0)) table.error("normals", "the normal has no length", {i});
      cloud->normals.emplace_back(unit(normals[i]));
    }
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
