// An instance of a mesh: the hits of a ray in the space of the world, or of the instance's group, and the
// surfaces there.
#pragma once

#include "host/reference/instance_map.hpp"
#include "host/reference/mesh_geometry.hpp"

namespace eyeray::engine::reference {

class InstanceGeometry {
 public:
  // `mesh` and `material` must outlive this instance. `material`: null if all of the mesh is hit, from both
  // sides.
  InstanceGeometry(const Instance& instance, const MeshGeometry& mesh, const Material* material = nullptr)
      : mesh_(&mesh), look_(material), map_(instance.transform), material_(instance.material) {}

  // The nearest hit, like MeshGeometry::intersect, for a ray in world space. t is the same in both spaces.
  std::optional<TriangleHit> intersect(const Ray& ray, double limit = std::numeric_limits<double>::infinity(),
                                       uint64_t first_id = 0) const {
    return mesh_->intersect(map_.into(ray), limit, look_, first_id);
  }
  uint32_t count_crossed(const Ray& ray, double t_end, uint32_t most, uint64_t first_id) const {
    return mesh_->count_crossed(map_.into(ray), t_end, most, look_, first_id);
  }

  // The surface at a hit, in the world. The ray is unused: with it, shapes and instances have the same
  // interface.
  SurfacePoint surface(const Ray& ray, const TriangleHit& hit) const;

  int material() const { return material_; }
  uint32_t triangles() const { return uint32_t(mesh_->mesh().triangles.size()); }
  // A box in the world around the mesh's own box.
  Bounds bounds() const { return map_.bounds(mesh_->bounds()); }
  // InstanceMap::reach() for the mesh, and for one triangle.
  double reach() const { return map_.reach(mesh_->bounds()); }
  double reach(uint32_t triangle, const Vec3& eye) const;
  double growth() const { return map_.growth(); }

 private:
  const MeshGeometry* mesh_;
  const Material* look_;
  InstanceMap map_;
  int material_;
};

}  // namespace eyeray::engine::reference
