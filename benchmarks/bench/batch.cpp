#include "benchmarks/bench/batch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/error.hpp"
#include "host/reference/camera.hpp"
#include "host/reference/rng.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/primitive_ids.hpp"

namespace eyeray::engine::bench {
namespace {

constexpr int block = 8;

struct Point {
  Vec3 position;
  Vec3 normal;  // unit, geometric
};

// The point where the ray hits a triangle of an instance, by the triangle's plane.
std::optional<Point> on_mesh(const Scene& scene, const Instance& instance, size_t triangle,
                             const Query& ray) {
  const Mesh& mesh = scene.meshes[size_t(instance.mesh)];
  Vec3 corners[3];
  for (size_t i = 0; i < 3; ++i)
    corners[i] = instance.transform * Vec4(mesh.positions[mesh.triangles[triangle][i]], 1);
  const Vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const double t = glm::dot(normal, corners[0] - ray.o) / glm::dot(normal, ray.d);
  if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
  return Point{ray.o + t * ray.d, normal};
}

std::optional<Point> on_shape(const Shape& shape, const Query& query) {
  const Ray ray{query.o, query.d};
  const std::optional<Intersection> hit = shape.intersect(ray);
  if (!hit || hit->iteration_limit) return std::nullopt;
  const SurfacePoint surface = shape.surface(ray, *hit);
  return Point{surface.position, surface.normal_geometric};
}

// The point where the ray hits the primitive at that location.
std::optional<Point> point_on(const Scene& scene, const PrimitiveIds::Location& at, const Query& ray) {
  if (at.group_instance < 0)
    return at.is_shape ? on_shape(*scene.shapes[at.index], ray)
                       : on_mesh(scene, scene.instances[at.index], at.triangle, ray);
  const GroupInstance& instance = scene.group_instances[size_t(at.group_instance)];
  const Group& group = scene.groups[size_t(instance.group)];
  const Affine map(instance.transform);
  const Affine back(glm::inverse(instance.transform));
  const Query local{back.point(ray.o), back.linear * ray.d, ray.t_max};
  const std::optional<Point> point = at.is_shape
                                         ? on_shape(*group.shapes[at.index], local)
                                         : on_mesh(scene, group.instances[at.index], at.triangle, local);
  if (!point) return std::nullopt;
  return Point{map.point(point->position), map.normal(point->normal)};
}

double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

Batch primary_batch(const Scene& scene, int width, int height) {
  ImageSettings image = scene.image;
  image.width = width;
  image.height = height;
  const reference::CameraRays camera(scene.camera, image);
  Batch batch{"primary", QueryKind::nearest, true, {}};
  batch.rays.reserve(size_t(width) * size_t(height));
  for (int top = 0; top < height; top += block) {
    for (int left = 0; left < width; left += block) {
      for (int y = top; y < std::min(top + block, height); ++y) {
        for (int x = left; x < std::min(left + block, width); ++x) {
          const Ray ray = camera.ray({x + 0.5, y + 0.5});
          batch.rays.push_back({ray.o, ray.d});
        }
      }
    }
  }
  return batch;
}

std::vector<SurfacePosition> surface_positions(const Scene& scene, std::span<const Query> rays,
                                               std::span<const QueryHit> hits) {
  CHECK_EQ(rays.size(), hits.size());
  const PrimitiveIds ids(scene);
  std::vector<SurfacePosition> found;
  for (size_t i = 0; i < rays.size(); ++i) {
    const int64_t primitive = hits[i].primitive;
    if (primitive < 0) continue;
    const std::optional<Point> point = point_on(scene, ids.locate(uint64_t(primitive), scene), rays[i]);
    if (!point) continue;
    const Vec3 normal = glm::dot(point->normal, rays[i].d) > 0 ? -point->normal : point->normal;
    const double offset = 0x1p-16 * std::max(largest(point->position), largest(point->position - rays[i].o));
    found.push_back({uint32_t(i), point->position + offset * normal, normal});
  }
  return found;
}

Batch shadow_batch(const Scene& scene, std::span<const SurfacePosition> surface_positions) {
  Batch batch{"shadow", QueryKind::any, true, {}};
  if (scene.lights.empty()) return batch;
  for (const SurfacePosition& from : surface_positions) {
    const Illumination to = scene.lights.front()->illuminate(from.position);
    if (glm::dot(to.l, from.normal) > 0)
      batch.rays.push_back({from.position, to.l, std::min(to.distance, Query{}.t_max)});
  }
  return batch;
}

Batch bounce_batch(std::span<const SurfacePosition> surface_positions, uint32_t seed) {
  Batch batch{"bounce", QueryKind::nearest, false, {}};
  batch.rays.reserve(surface_positions.size());
  for (const SurfacePosition& from : surface_positions) {
    // A point on the unit sphere around the normal's tip: the directions to it have the cosine's density.
    const double z = 2 * reference::random(from.ray, 0, 0, seed) - 1;
    const double phi = 2 * std::numbers::pi * reference::random(from.ray, 0, 1, seed);
    const double r = std::sqrt(1 - z * z);
    const Vec3 d = from.normal + 0.9999 * Vec3(r * std::cos(phi), r * std::sin(phi), z);
    batch.rays.push_back({from.position, glm::normalize(d)});
  }
  return batch;
}

}  // namespace eyeray::engine::bench
