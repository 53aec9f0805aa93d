// The map from the object space of a mesh or group to world space, and the rounding on the way.
#pragma once

#include "host/scene/affine.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

class InstanceMap {
 public:
  explicit InstanceMap(const Mat4& to_world) : to_world_(to_world) {}

  // The direction keeps its length, so that t is the same in both.
  Ray into(const Ray& world) const;
  // A surface of the space, in the world.
  SurfacePoint out(const SurfacePoint& local) const;
  // In the world: around a box of the space.
  Bounds bounds(const Bounds& box) const;
  // The largest terms of which a coordinate in the world, relative to `eye`, of a point of the box is the
  // sum, …
  double reach(const Bounds& box, const Vec3& eye = Vec3(0)) const;
  // … and how many times the rounding of a point grows, at most, on its way into the space and back.
  double growth() const;

 private:
  Affine to_world_;
};

}  // namespace eyeray::engine::reference
