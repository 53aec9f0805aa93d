#include "host/reference/context_on.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/rng.hpp"

namespace eyeray::engine::reference {

extern const Integrator raycast_integrator;

namespace {

constexpr std::string_view manual =
    "Only camera rays are traced. The first surface is shown in its own colour, lit without shadows. In a "
    "scene without lights, a light at the eye illuminates it.";

PixelSample raycast(const Tracer& tracer, const SampleId& id, const Ray& camera_ray, const MediaStack&,
                    const rounding::Displacement& displacement, const Observer& observer) {
  const Scene& scene = tracer.scene();
  Ray ray = camera_ray;
  ray.alpha_key = alpha_key(id.pixel, id.index, 0, 0, scene.render.seed);
  uint32_t flags = 0;
  const auto hit = tracer.trace(ray, flags, displacement.coincident);
  if (!hit) {
    const bool transparent = scene.image.transparent;
    const Vec3 color = transparent         ? Vec3(0)
                       : scene.environment ? environment_radiance(*scene.environment, ray.d)
                                           : scene.render.background;
    observer.miss(Vec3(1), color);
    return {.color = color, .rays = 1, .flags = flags, .background = transparent ? 1.0 : 0.0};
  }

  const SurfacePoint surface = tracer.surface(ray, *hit);
  observer.hit(tracer, ray, *hit, surface);
  const bool front = glm::dot(ray.d, surface.normal_geometric) < 0;
  const Vec3 n = front ? surface.normal : -surface.normal;

  Vec3 light(0);
  if (scene.lights.empty()) {
    light = Vec3(glm::abs(glm::dot(n, ray.d)) / glm::length(ray.d));
  } else {
    light = scene.render.ambient;
    for (const auto& source : scene.lights) {
      const Illumination illumination = source->illuminate(surface.position);
      const double cosine = glm::dot(n, illumination.l);
      if (cosine > 0) light += illumination.color * cosine;
    }
  }
  const Vec3 base = scene.materials[size_t(hit->material)]->base_color(context_on(surface)) * surface.color;
  observer.value("light", base * light);
  return {.color = base * light, .rays = 1, .hits = 1, .flags = flags};
}

}  // namespace

extern const Integrator raycast_integrator{.manual = manual, .sample = raycast};

}  // namespace eyeray::engine::reference
