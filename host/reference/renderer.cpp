#include "reference/renderer.hpp"

#include "reference/raycast.hpp"
#include "reference/whitted.hpp"

namespace eyeray::reference {

Renderer::Renderer(const Scene& scene, Acceleration acceleration)
    : scene_(scene), tracer_(scene, acceleration), camera_(scene.camera, scene.image) {
  for (const int material : media_at(tracer_, scene.camera.eye))
    if (!media_.push(material)) flags_ |= media_overflow;
}

PixelSample Renderer::sample(int x, int y, uint32_t index, Vec2 shift) const {
  const Vec2 place = sample_place(scene_.image, scene_.render.seed, x, y, index);
  const Ray ray = camera_.ray(Vec2(x, y) + place + shift);
  if (scene_.render.integrator == IntegratorType::raycast) return raycast(tracer_, ray);
  PixelSample sample = whitted(tracer_, ray, media_);
  sample.flags |= flags_;
  return sample;
}

FirstHit Renderer::first_hit(int x, int y, Vec2 shift) const {
  const Ray ray = camera_.ray(Vec2(x, y) + Vec2(0.5) + shift);
  const auto hit = tracer_.trace(ray);
  if (!hit) return {};
  const SurfacePoint surface = tracer_.surface(ray, *hit);
  return {hit->at.t, surface.position, surface.normal, surface.uv, int32_t(hit->primitive), hit->material};
}

}  // namespace eyeray::reference
