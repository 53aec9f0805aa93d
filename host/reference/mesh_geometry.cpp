#include "host/reference/mesh_geometry.hpp"

#include <algorithm>

#include "host/reference/rng.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::reference {

namespace {

Bounds bounds_of(const Corners& corners) {
  Bounds bounds;
  for (const Vec3& corner : corners) bounds.include(corner);
  return bounds;
}

}  // namespace

MeshGeometry::MeshGeometry(const Mesh& mesh, Acceleration acceleration)
    : mesh_(mesh),
      bounds_(eyeray::engine::bounds(mesh)),
      bvh_(
          uint32_t(mesh.triangles.size()), [this](uint32_t i) { return bounds_of(corners(i)); },
          acceleration) {}

Corners MeshGeometry::corners(uint32_t triangle) const {
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return {mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]};
}

BoxRay MeshGeometry::box_ray(const Ray& ray) const {
  const double reach = std::max(magnitude(bounds_.min), magnitude(bounds_.max));
  return {ray, box_rounding * (magnitude(ray.o) + reach)};
}

std::optional<TriangleHit> MeshGeometry::intersect_one(uint32_t triangle, const Ray& ray,
                                                       const BoxRay& box_ray, const Material* material,
                                                       uint64_t first_id) const {
  const Corners v = corners(triangle);
  const double entry = box_ray.entry(bounds_of(v));
  if (entry == std::numeric_limits<double>::infinity()) return std::nullopt;
  const Vec3 normal = geometric_normal(v);
  auto hit = intersect_triangle(v, normal, ray);
  if (!hit || (material && material->front_only && glm::dot(normal, ray.d) >= 0)) return std::nullopt;

  // By rounding, a ray that grazes the triangle's plane may get a t before its entry into the box.
  hit->t = std::max(hit->t, entry);
  const TriangleHit at{*hit, triangle};
  if (material && material->mask &&
      !material->mask->covers(uv(at), alpha(at), least_alpha(ray.alpha_key, first_id + triangle)))
    return std::nullopt;
  return at;
}

Vec2 MeshGeometry::uv(const TriangleHit& hit) const {
  if (mesh_.uv.empty()) return {hit.u, hit.v};
  const auto& [a, b, c] = mesh_.triangles[hit.triangle];
  return mesh_.uv[a] * (1 - hit.u - hit.v) + mesh_.uv[b] * hit.u + mesh_.uv[c] * hit.v;
}

// The alpha interpolated from the triangle's vertices; exact where all three are equal.
double MeshGeometry::alpha(const TriangleHit& hit) const {
  if (mesh_.alphas.empty()) return 1;
  const auto& [a, b, c] = mesh_.triangles[hit.triangle];
  const auto& of = mesh_.alphas;
  return of[a] + (of[b] - of[a]) * hit.u + (of[c] - of[a]) * hit.v;
}

std::optional<TriangleHit> MeshGeometry::intersect(const Ray& ray, double limit, const Material* material,
                                                   uint64_t first_id) const {
  std::optional<TriangleHit> nearest;
  const BoxRay boxes = box_ray(ray);
  bvh_.search(boxes, limit, [&](uint32_t i, double so_far) {
    const auto hit = intersect_one(i, ray, boxes, material, first_id);
    if (!hit || (nearest && !(hit->t < nearest->t || (hit->t == nearest->t && i < nearest->triangle))))
      return so_far;
    nearest = hit;
    return std::min(so_far, hit->t);
  });
  return nearest;
}

uint32_t MeshGeometry::count_crossed(const Ray& ray, double t_end, uint32_t most, const Material* material,
                                     uint64_t first_id) const {
  uint32_t count = 0;
  const BoxRay boxes = box_ray(ray);
  bvh_.search(boxes, t_end, [&](uint32_t i, double limit) {
    const auto hit = intersect_one(i, ray, boxes, material, first_id);
    if (!hit || !(hit->t < t_end)) return limit;
    return ++count < most ? limit : -1.0;
  });
  return count;
}

}  // namespace eyeray::engine::reference
