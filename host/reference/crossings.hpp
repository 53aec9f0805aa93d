// The origins of rays that leave a surface, and all crossings of a ray with one object.
#pragma once

#include <cmath>

#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

// The side on which a ray leaves a surface. `straight`: the side to which it points. `in_front`, `behind`:
// that side of normal_side, for a scattered ray, which a smooth triangle lifts there.
enum class Leaving { straight, in_front, behind };

// The origin of a ray that leaves a surface point in direction `d`. It is off the surface on the side of `d`,
// by a few error bounds and at least by `least`, so that the ray does not hit the surface that it leaves. As
// in the shaders (geometry/ray.glsl), the origin is moved along the ray's own line if that is steep. Near an
// edge the ray then starts beyond the same other face. With `along_normal` the origin is always moved along
// the normal.
Vec3 spawn_origin(const SurfacePoint& point, const Vec3& d, double least = 0, bool along_normal = false,
                  Leaving leaving = Leaving::straight);

// The displacement that brings a point of a triangle inside of each edge by `room`, or by a quarter of the
// triangle's height if that is less; 0 on any other surface. As in the shaders (triangle_inward), it is
// perpendicular to the nearest edge unless another edge is near as well.
Vec3 way_inside(const SurfacePoint& point, double room);

// Many more than the surfaces of a mesh that a ray can sensibly cross.
inline constexpr int most_crossings = 1 << 20;

// Calls visit(t, hit, surface) for each crossing of the ray with the object, in order of t, until `visit`
// returns false. The object has the functions `intersect` and `surface` of a Shape. The calls also end after
// the object's most_crossings() (the constant most_crossings if it has none), or if rounding stops the ray
// from advancing. Returns infinity, or the t beyond which crossings may be missing because a search ran out
// of steps.
template <typename Object, typename Visit>
double for_each_crossing(const Object& object, const Ray& ray, const Visit& visit) {
  int most = most_crossings;
  if constexpr (requires { object.most_crossings(); }) most = object.most_crossings();
  // The ray restarts behind each crossing; `passed` is the t of its new origin on the given ray.
  Ray rest = ray;
  double passed = 0;
  for (int crossings = 0; crossings < most; ++crossings) {
    const auto hit = object.intersect(rest);
    if (!hit) break;
    if (hit->iteration_limit) return passed + hit->t;
    const SurfacePoint surface = object.surface(rest, *hit);
    if (!visit(passed + hit->t, *hit, surface)) break;
    rest.o = spawn_origin(surface, ray.d);
    const double before = passed;
    passed = glm::dot(rest.o - ray.o, ray.d) / glm::dot(ray.d, ray.d);
    if (!(passed > before)) break;
  }
  return HUGE_VAL;
}

}  // namespace eyeray::engine::reference
