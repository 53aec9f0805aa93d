// The objects of one space, which is the world's or a group's: shapes, then instances of meshes, with a BVH
// over all.
#pragma once

#include <deque>
#include <span>

#include "host/reference/instance_geometry.hpp"
#include "host/scene/primitive_ids.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

class Objects {
 public:
  // Shapes, instances, meshes and materials must outlive this object. `meshes` and `materials` are the
  // scene's. `first_ids`: for each object, the primitive index of the shape or of the instance's first
  // triangle. In a group these indices count from the group's own first shape and first triangle; the
  // functions below add `before` to them.
  Objects(std::span<const std::unique_ptr<Shape>> shapes, std::span<const Instance> instances,
          const std::deque<MeshGeometry>& meshes, std::span<const std::unique_ptr<Material>> materials,
          std::vector<uint64_t> first_ids, Acceleration acceleration);

  struct Hit {
    TriangleHit at;  // for a shape: its intersection
    size_t object;   // an index: shapes first, then instances
  };
  // The nearest hit with t > 0; if several have exactly the same t, the one of the lowest object. A hit
  // beyond `limit` may be missing. If the allowed steps did not suffice for a shape, `sure_until` is lowered
  // to the t up to which the ray does not hit that shape.
  std::optional<Hit> trace(const Ray& ray, double limit, double& sure_until,
                           const PrimitiveIds::First& before = {}) const;
  // The surface at a hit of `ray`.
  SurfacePoint surface(const Ray& ray, const Hit& hit) const;

  size_t size() const { return shapes_.size() + instances_.size(); }
  // The material of an instance, or of the part of a shape that has the surface at the hit.
  int material(const Hit& hit) const;
  std::optional<Hit> intersect(size_t object, const Ray& ray,
                               double limit = std::numeric_limits<double>::infinity(),
                               const PrimitiveIds::First& before = {}) const;
  // The largest number of times that a line can cross the object, as far as it is known.
  int most_crossings(size_t object) const;
  // Calls visit(material) for each material of the object's surfaces.
  template <typename Visit>
  void for_each_material(size_t object, const Visit& visit) const {
    if (!is_shape(object)) return visit(instances_[object - shapes_.size()].material());
    for_each_leaf(*shapes_[object], [&](const Shape& leaf) { visit(leaf.material); });
  }
  bool is_shape(size_t object) const { return object < shapes_.size(); }
  // The primitive index of a shape, or of an instance's first triangle.
  uint64_t first_id(size_t object, const PrimitiveIds::First& before = {}) const {
    return first_ids_[object] + (is_shape(object) ? before.shape : before.triangle);
  }

  // Adds a share of transmitted light for each object that blocks any light at 0 < t < t_end, in any order.
  // Returns true if all light is lost. A shape counts once, unless it counts_crossings(). Each triangle of an
  // instance, and each crossing of such a shape, transmits the square root of its material's share. So a
  // closed mesh, which is crossed twice, counts once as well. Sets `gave_up` if the allowed steps did not
  // suffice for a shape.
  struct Share {
    size_t space;  // the argument of add_shares
    size_t object;
    double share;
  };
  bool add_shares(const Ray& ray, double t_end, size_t space, std::vector<Share>& shares, bool& gave_up,
                  const PrimitiveIds::First& before = {}) const;

  // A box around all bounded objects.
  const Bounds& bounds() const { return bounds_; }
  // The largest coordinate, relative to `eye`, in any computation of the hit primitive; 0 for unbounded
  // shapes.
  double reach(const Hit& hit, const Vec3& eye) const;
  // The largest factor by which the rounding of a point grows on its way into an instance and back.
  double growth() const { return growth_; }

 private:
  std::optional<Intersection> intersect_shape(size_t shape, const Ray& ray,
                                              const PrimitiveIds::First& before) const;
  double share_of_shape(size_t shape, const Ray& ray, double entry, double t_end, bool& gave_up,
                        const PrimitiveIds::First& before) const;
  double share_of_instance(size_t object, const Ray& ray, double t_end,
                           const PrimitiveIds::First& before) const;
  template <typename Visit>
  void for_each_entered(const Ray& ray, double limit, const Visit& visit) const;

  std::span<const std::unique_ptr<Shape>> shapes_;
  std::span<const std::unique_ptr<Material>> materials_;
  std::vector<InstanceGeometry> instances_;
  std::vector<uint64_t> first_ids_;  // for each object
  std::vector<uint32_t> unbounded_;  // indices of shapes without finite bounds
  std::vector<uint32_t> bounded_;    // indices of the objects with finite bounds
  std::vector<Bounds> boxes_;        // the boxes of bounded_
  Bounds bounds_;
  double reach_ = 0;   // the largest coordinate in any computation that yields a box
  double growth_ = 1;  // the largest growth() of all instances
  BoxBvh bvh_;         // BVH over boxes_
};

}  // namespace eyeray::engine::reference
