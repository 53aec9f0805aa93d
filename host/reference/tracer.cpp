#include "reference/tracer.hpp"

namespace eyeray::reference {

std::optional<Hit> trace(const Scene& scene, const Ray& ray) {
  std::optional<Hit> nearest;
  for (size_t i = 0; i < scene.shapes.size(); ++i) {
    const auto hit = scene.shapes[i]->intersect(ray);
    if (hit && (!nearest || hit->t < nearest->intersection.t)) nearest = Hit{int(i), *hit};
  }
  return nearest;
}

Vec3 departure(const SurfacePoint& point, const Vec3& d) {
  const double offset = 4 * point.position_error;
  return point.position +
         point.normal_geometric * (glm::dot(d, point.normal_geometric) >= 0 ? offset : -offset);
}

double transmittance(const Scene& scene, const Ray& ray, double t_end) {
  double share = 1;
  for (const auto& shape : scene.shapes) {
    const auto hit = shape->intersect(ray);
    if (hit && hit->t < t_end) share *= scene.materials[size_t(shape->material)]->shadow_transmittance();
    if (share == 0) return 0;
  }
  return share;
}

}  // namespace eyeray::reference
