#include "host/reference/instance_map.hpp"

namespace eyeray::engine::reference {

namespace {

// The magnitude of each component: this matrix maps bounds of errors.
Mat3 size(const Mat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

}  // namespace

Ray InstanceMap::into(const Ray& ray) const {
  // v · M is Mᵀ · v. The difference comes first: near the instance it is exact or nearly so.
  return {(ray.o - to_world_.offset) * to_world_.cotangent, ray.d * to_world_.cotangent, ray.alpha_key};
}

SurfacePoint InstanceMap::out(const SurfacePoint& local) const {
  const Vec3 across = to_world_.cotangent * local.normal_geometric;
  const Vec3 shading = to_world_.cotangent * local.normal;
  SurfacePoint point = local;
  point.position = to_world_.point(local.position);
  point.normal_geometric = unit(across);
  point.normal = unit(shading);
  point.lift = local.lift / glm::length(shading);
  for (Vec3& edge : point.edges) edge = to_world_.linear * edge;
  point.along_u = to_world_.linear * local.along_u;
  point.along_v = to_world_.linear * local.along_v;
  const auto out_tangent = [&](const Vec4& tangent) {
    return Vec4(to_world_.linear * Vec3(tangent), tangent.w * (to_world_.mirrors() ? -1 : 1));
  };
  point.tangent = out_tangent(local.tangent);
  if (point.second) {
    point.second->along_u = to_world_.linear * local.second->along_u;
    point.second->along_v = to_world_.linear * local.second->along_v;
    point.second->tangent = out_tangent(local.second->tangent);
  }

  // The next ray starts at this point, and is mapped back into the space. There it may be off by the rounding
  // of both maps, of which the part across the surface counts. A distance e across the surface is e /
  // |across| in the world.
  const double in_space =
      magnitude(size(glm::transpose(to_world_.cotangent)) * glm::abs(point.position - to_world_.offset));
  const double world_ray =
      magnitude(size(to_world_.linear) * glm::abs(local.position)) + magnitude(to_world_.offset);
  point.position_error = (local.position_error + 1e-13 * in_space) / glm::length(across) + 1e-13 * world_ray;
  return point;
}

Bounds InstanceMap::bounds(const Bounds& box) const {
  Bounds bounds;
  for (int corner = 0; corner < 8; ++corner)
    bounds.include(to_world_.point({(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                                    (corner & 4 ? box.max : box.min).z}));
  return bounds;
}

double InstanceMap::reach(const Bounds& box, const Vec3& eye) const {
  const Vec3 extremes = glm::max(glm::abs(box.min), glm::abs(box.max));
  return magnitude(size(to_world_.linear) * extremes) + magnitude(to_world_.offset - eye);
}

double InstanceMap::growth() const {
  return magnitude(size(to_world_.linear) * (size(glm::transpose(to_world_.cotangent)) * Vec3(1)));
}

}  // namespace eyeray::engine::reference
