#include "reference/instance_geometry.hpp"

#include <algorithm>

namespace eyeray::reference {

namespace {

Mat3 by_component(const Mat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

// The largest coordinates of a box, by axis.
Vec3 extremes(const Bounds& bounds) {
  return glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
}

template <typename T>
T interpolate(const std::vector<T>& values, const std::array<uint32_t, 3>& corners, const Intersection& hit) {
  return values[corners[0]] * (1 - hit.u - hit.v) + values[corners[1]] * hit.u + values[corners[2]] * hit.v;
}

}  // namespace

InstanceGeometry::InstanceGeometry(const Instance& instance, const MeshGeometry& mesh, const AlphaMask* mask)
    : mesh_(&mesh),
      mask_(mask),
      to_world_(instance.transform),
      material_(instance.material),
      size_(by_component(to_world_.linear)),
      inverse_size_(by_component(glm::transpose(to_world_.cotangent))) {}

Ray InstanceGeometry::to_mesh(const Ray& ray) const {
  // v · M is Mᵀ · v. The difference comes first: near the instance it is exact or nearly so.
  return {(ray.o - to_world_.offset) * to_world_.cotangent, ray.d * to_world_.cotangent};
}

SurfacePoint InstanceGeometry::surface(const Ray&, const TriangleHit& hit) const {
  const Mesh& mesh = mesh_->mesh();
  const auto& triangle = mesh.triangles[hit.triangle];
  const Corners v = mesh_->corners(hit.triangle);
  const Vec3 normal = geometric_normal(v);
  const Vec3 across = to_world_.cotangent * normal;

  // Put the point onto the plane that t comes from: a sliver's normal is so rough that the corners may lie
  // off it by far more than their own rounding.
  Vec3 position = v[0] + (v[1] - v[0]) * hit.u + (v[2] - v[0]) * hit.v;
  position -= normal * glm::dot(normal, position - v[0]);

  SurfacePoint point;
  point.position = to_world_.point(position);
  point.normal_geometric = unit(across);
  point.normal = point.normal_geometric;
  if (!mesh.normals.empty()) {
    const Vec3 shading = to_world_.cotangent * interpolate(mesh.normals, triangle, hit);
    if (glm::dot(shading, point.normal_geometric) > 0) point.normal = unit(shading);
  }
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, triangle, hit);
  point.uv = mesh_->uv(hit);

  // The next ray starts here and goes back into the mesh's space: there it may be off by the rounding of both
  // maps, which counts across the triangle. A distance e across it is e / |across| in the world.
  const double in_mesh = std::max({magnitude(v[0]), magnitude(v[1]), magnitude(v[2]),
                                   magnitude(inverse_size_ * glm::abs(point.position - to_world_.offset))});
  const double in_world = magnitude(size_ * glm::abs(position)) + magnitude(to_world_.offset);
  point.position_error = 1e-13 * (in_mesh / glm::length(across) + in_world);
  return point;
}

Bounds InstanceGeometry::bounds() const {
  const Bounds& box = mesh_->bounds();
  Bounds bounds;
  for (int corner = 0; corner < 8; ++corner)
    bounds.include(to_world_.point({(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                                    (corner & 4 ? box.max : box.min).z}));
  return bounds;
}

double InstanceGeometry::reach() const {
  return magnitude(size_ * extremes(mesh_->bounds())) + magnitude(to_world_.offset);
}

double InstanceGeometry::reach(uint32_t triangle, const Vec3& eye) const {
  double reach = 0;
  for (const Vec3& corner : mesh_->corners(triangle))
    reach = std::max(reach, magnitude(size_ * glm::abs(corner)));
  return reach + magnitude(to_world_.offset - eye);
}

double InstanceGeometry::growth() const {
  return magnitude(size_ * (inverse_size_ * Vec3(1)));
}

}  // namespace eyeray::reference
