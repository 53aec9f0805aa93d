// Continues a ray from a surface: off it, and from crossing to crossing of one object.
#pragma once

#include <cmath>

#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

// A ray leaves a surface straight on, on the side that it points to; or scattered to one side of normal_side,
// where a smooth triangle lifts it.
enum class Leaving { straight, in_front, behind };

// The origin of a ray that leaves a surface point in direction `d`. It is off the surface by a few error
// bounds, and by `least`, on the side of `d`, so that the ray does not hit the surface that it leaves. As the
// shaders do (geometry/ray.glsl), it stays on its line where that is steep: near an edge it then starts
// beyond the same other face. With `along_normal` it never does.
Vec3 spawn_origin(const SurfacePoint& point, const Vec3& d, double least = 0, bool along_normal = false,
                  Leaving leaving = Leaving::straight);

// The way from a triangle's point to where it is `room` inside of each edge, or a quarter of the triangle's
// height if that is less; 0 on any other surface. As the shaders do (triangle_inward), it is perpendicular to
// the edge that is nearest unless another one is near.
Vec3 way_inside(const SurfacePoint& point, double room);

// Many more than the surfaces of a mesh that a ray can sensibly cross.
inline constexpr int most_crossings = 1 << 20;

// Calls visit(t, hit, surface) for each crossing of the object, which has a Shape's `intersect` and
// `surface`, in order of t, until `visit` returns false. It ends after the object's most_crossings(), else
// most_crossings, and where rounding lets a ray come no further. Returns up to which t none is left out for
// want of steps, infinity for all.
template <typename Object, typename Visit>
double for_each_crossing(const Object& object, const Ray& ray, const Visit& visit) {
  int most = most_crossings;
  if constexpr (requires { object.most_crossings(); }) most = object.most_crossings();
  // Start anew behind each crossing; t stays that of the ray as given.
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
