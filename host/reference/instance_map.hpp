// The map from the object space of a mesh or group to world space, and the rounding on the way.
#pragma once

#include "host/scene/affine.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

class InstanceMap {
 public:
  explicit InstanceMap(const Mat4& to_world) : to_world_(to_world) {}

  // Maps a ray into the object space. The direction is not normalised, so that t is the same in both spaces.
  Ray into(const Ray& world) const;
  // Maps a surface of the object space to the world.
  SurfacePoint out(const SurfacePoint& local) const;
  // A box in the world around a box of the object space.
  Bounds bounds(const Bounds& box) const;
  // For points of the box: a bound on the magnitudes of the terms whose sum is a world coordinate relative to
  // `eye`.
  double reach(const Bounds& box, const Vec3& eye = Vec3(0)) const;
  // The largest factor by which the rounding of a point grows on its way into the object space and back.
  double growth() const;

 private:
  Affine to_world_;
};

}  // namespace eyeray::engine::reference
