#include "reference/raycast.hpp"

#include "reference/light.hpp"
#include "reference/tracer.hpp"

namespace eyeray::reference {

PixelSample raycast(const Scene& scene, const Ray& ray) {
  const auto hit = trace(scene, ray);
  if (!hit) return {.color = scene.render.background, .rays = 1};

  const Shape& shape = *scene.shapes[size_t(hit->primitive)];
  const SurfacePoint surface = shape.surface(ray, hit->intersection);
  const bool front = glm::dot(ray.d, surface.normal_geometric) < 0;
  const Vec3 n = front ? surface.normal : -surface.normal;

  Vec3 light(0);
  if (scene.lights.empty()) {
    light = Vec3(glm::abs(glm::dot(n, ray.d)) / glm::length(ray.d));
  } else {
    light = scene.render.ambient;
    for (const Light& source : scene.lights) {
      const Illumination illumination = illuminate(source, surface.position);
      const double cosine = glm::dot(n, illumination.l);
      if (cosine > 0) light += illumination.color * cosine;
    }
  }
  return {
      .color = scene.materials[size_t(shape.material)]->base_color(surface.uv) * light, .rays = 1, .hits = 1};
}

}  // namespace eyeray::reference
