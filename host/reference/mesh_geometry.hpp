// Intersects rays with a mesh, in the mesh's object space.
#pragma once

#include <optional>

#include "host/scene/box_bvh.hpp"
#include "host/scene/material.hpp"
#include "host/scene/mesh.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine::reference {

struct TriangleHit : Intersection {
  uint32_t triangle = 0;  // index in Mesh::triangles
};

class MeshGeometry {
 public:
  // `mesh` must outlive it.
  MeshGeometry(const Mesh& mesh, Acceleration acceleration);

  // The nearest hit with t > 0; if several have exactly the same t, the one of the lowest triangle. A hit
  // beyond `limit` may be missing. With a material, its cutouts are not hit. If it is `front_only`, triangles
  // are not hit from behind either. `first_id`: the scene's primitive index of the first triangle, needed if
  // the material blends.
  std::optional<TriangleHit> intersect(const Ray& ray, double limit, const Material* material = nullptr,
                                       uint64_t first_id = 0) const;
  // The number of triangles that the ray hits at 0 < t < t_end. Counting ends at `most`.
  uint32_t count_crossed(const Ray& ray, double t_end, uint32_t most, const Material* material = nullptr,
                         uint64_t first_id = 0) const;

  // Texture coordinates at a hit.
  Vec2 uv(const TriangleHit& hit) const;

  const Mesh& mesh() const { return mesh_; }
  const Bounds& bounds() const { return bounds_; }
  Corners corners(uint32_t triangle) const;

 private:
  BoxRay box_ray(const Ray& ray) const;
  std::optional<TriangleHit> intersect_one(uint32_t triangle, const Ray& ray, const BoxRay& box_ray,
                                           const Material* material, uint64_t first_id) const;
  double alpha(const TriangleHit& hit) const;

  const Mesh& mesh_;
  Bounds bounds_;
  BoxBvh bvh_;
};

}  // namespace eyeray::engine::reference
