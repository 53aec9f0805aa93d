// What a ray meets: every shape is asked, none is left out.
#pragma once

#include "scene/scene.hpp"

namespace eyeray::reference {

struct Hit {
  int primitive;  // index in Scene::shapes
  Intersection intersection;
};

// The nearest hit with t > 0; of exactly equal ones that of the lowest primitive.
std::optional<Hit> trace(const Scene& scene, const Ray& ray);

// Where a ray into direction `d` leaves from a surface point: off the surface by a few error bounds, on the
// side of `d`, so that the ray does not meet the surface that it leaves.
Vec3 departure(const SurfacePoint& point, const Vec3& d);

// Calls visit(t, surface) for each crossing of the shape, in order of t, until `visit` returns false.
template <typename Visit>
void for_each_crossing(const Shape& shape, const Ray& ray, const Visit& visit) {
  // Start anew behind each crossing; t stays that of the ray as given.
  Ray rest = ray;
  double passed = 0;
  while (const auto hit = shape.intersect(rest)) {
    const SurfacePoint surface = shape.surface(rest, *hit);
    if (!visit(passed + hit->t, surface)) return;
    rest.o = departure(surface, ray.d);
    passed = glm::dot(rest.o - ray.o, ray.d) / glm::dot(ray.d, ray.d);
  }
}

// The share of light that comes through all shapes that the ray meets at 0 < t < t_end, each counted once.
double transmittance(const Scene& scene, const Ray& ray, double t_end);

}  // namespace eyeray::reference
