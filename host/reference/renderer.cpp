#include "reference/renderer.hpp"

#include "reference/raycast.hpp"
#include "reference/tracer.hpp"
#include "reference/whitted.hpp"

namespace eyeray::reference {

Renderer::Renderer(const Scene& scene) : scene_(scene), camera_(scene.camera, scene.image) {
  for (const int material : media_at(scene, scene.camera.eye))
    if (!media_.push(material)) flags_ |= media_overflow;
}

PixelSample Renderer::sample(int x, int y, uint32_t index, Vec2 shift) const {
  const Vec2 place = sample_place(scene_.image, scene_.render.seed, x, y, index);
  const Ray ray = camera_.ray(Vec2(x, y) + place + shift);
  if (scene_.render.integrator == IntegratorType::raycast) return raycast(scene_, ray);
  PixelSample sample = whitted(scene_, ray, media_);
  sample.flags |= flags_;
  return sample;
}

FirstHit Renderer::first_hit(int x, int y, Vec2 shift) const {
  const Ray ray = camera_.ray(Vec2(x, y) + Vec2(0.5) + shift);
  const auto hit = trace(scene_, ray);
  if (!hit) return {};
  const Shape& shape = *scene_.shapes[size_t(hit->primitive)];
  const SurfacePoint surface = shape.surface(ray, hit->intersection);
  return {hit->intersection.t, surface.position, surface.normal, surface.uv, hit->primitive, shape.material};
}

}  // namespace eyeray::reference
