#include "host/reference/instance_geometry.hpp"

#include <algorithm>
#include <tuple>

namespace eyeray::engine::reference {

namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const std::array<uint32_t, 3>& corners, const Intersection& hit) {
  return values[corners[0]] * (1 - hit.u - hit.v) + values[corners[1]] * hit.u + values[corners[2]] * hit.v;
}

}  // namespace

SurfacePoint InstanceGeometry::surface(const Ray&, const TriangleHit& hit) const {
  const Mesh& mesh = mesh_->mesh();
  const auto& triangle = mesh.triangles[hit.triangle];
  const Corners v = mesh_->corners(hit.triangle);

  // Project the point onto the plane from which t was computed. A sliver's normal is so inaccurate that the
  // corners may lie off that plane by far more than their own rounding.
  SurfacePoint point;
  point.normal_geometric = geometric_normal(v);
  point.position = v[0] + (v[1] - v[0]) * hit.u + (v[2] - v[0]) * hit.v;
  point.position -= point.normal_geometric * glm::dot(point.normal_geometric, point.position - v[0]);
  point.position_error = 1e-13 * std::max({magnitude(v[0]), magnitude(v[1]), magnitude(v[2])});
  point.normal = point.normal_geometric;
  set_edges(point, v, hit);
  if (!mesh.normals.empty())
    set_smooth(point, v, {mesh.normals[triangle[0]], mesh.normals[triangle[1]], mesh.normals[triangle[2]]},
               {1 - hit.u - hit.v, hit.u, hit.v});
  if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, triangle, hit);
  point.uv = mesh_->uv(hit);
  const auto at_corners = [&, &corners = triangle](const std::vector<Vec2>& uv) {
    return std::array{uv[corners[0]], uv[corners[1]], uv[corners[2]]};
  };
  std::tie(point.along_u, point.along_v) =
      along_uv(v, mesh.uv.empty() ? corner_weights : at_corners(mesh.uv));
  if (!mesh.second_uv.empty()) {
    const auto [along_u, along_v] = along_uv(v, at_corners(mesh.second_uv));
    point.second = {interpolate(mesh.second_uv, triangle, hit), along_u, along_v, Vec4(0)};
  }
  if (!mesh.tangents.empty()) {
    Vec4& tangent = mesh.second_tangents ? point.second->tangent : point.tangent;
    tangent = interpolate(mesh.tangents, triangle, hit);
    tangent.w = mesh.tangents[triangle[0]].w;
  }
  return map_.out(point);
}

double InstanceGeometry::reach(uint32_t triangle, const Vec3& eye) const {
  Bounds box;
  for (const Vec3& corner : mesh_->corners(triangle)) box.include(corner);
  return map_.reach(box, eye);
}

}  // namespace eyeray::engine::reference
