// An instance of a mesh: what a ray of the world meets of it, and the surface there.
#pragma once

#include "reference/mesh_geometry.hpp"
#include "scene/affine.hpp"
#include "scene/shape.hpp"

namespace eyeray::reference {

class InstanceGeometry {
 public:
  // `mesh`, and the `mask` of the instance's material, null without one, must outlive it.
  InstanceGeometry(const Instance& instance, const MeshGeometry& mesh, const AlphaMask* mask = nullptr);

  // As MeshGeometry's, for a ray of the world; t is the same in both spaces.
  std::optional<TriangleHit> intersect(const Ray& ray,
                                       double limit = std::numeric_limits<double>::infinity()) const {
    return mesh_->intersect(to_mesh(ray), limit, mask_);
  }
  uint32_t count_crossed(const Ray& ray, double t_end, uint32_t most) const {
    return mesh_->count_crossed(to_mesh(ray), t_end, most, mask_);
  }

  // The surface at a hit, in the world. The ray is not needed, and there so that shapes and instances are
  // asked alike.
  SurfacePoint surface(const Ray& ray, const TriangleHit& hit) const;

  int material() const { return material_; }
  uint32_t triangles() const { return uint32_t(mesh_->mesh().triangles.size()); }
  // In the world: around the mesh's own box.
  Bounds bounds() const;
  // The largest terms of which a coordinate in the world is the sum, …
  double reach() const;
  // (those of one triangle, relative to `eye`)
  double reach(uint32_t triangle, const Vec3& eye) const;
  // … and how many times the rounding of a point grows, at most, on its way into the mesh's space and back.
  double growth() const;

 private:
  Ray to_mesh(const Ray& ray) const;

  const MeshGeometry* mesh_;
  const AlphaMask* mask_;
  Affine to_world_;
  int material_;
  Mat3 size_, inverse_size_;  // |linear| and |linear⁻¹|, by component: they carry bounds of errors along
};

}  // namespace eyeray::reference
