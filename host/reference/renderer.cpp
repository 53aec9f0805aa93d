#include "host/reference/renderer.hpp"

#include <algorithm>
#include <cmath>

#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::reference {

Renderer::Renderer(const Scene& scene, Acceleration acceleration)
    : scene_(scene), tracer_(scene, acceleration), camera_(scene.camera, scene.image) {
  for (const int material : media_at(tracer_, scene.camera.eye))
    if (!media_.push(material)) flags_ |= media_overflow;
}

Renderer::Aim Renderer::aim(int x, int y, uint32_t index) const {
  const ImageSettings& image = scene_.image;
  const uint32_t pixel = uint32_t(y) * uint32_t(image.width) + uint32_t(x), seed = scene_.render.seed;
  return {Vec2(x, y) + sample_position(image, seed, x, y, index),
          camera_.lens_point(sampler(image.pattern).pair(pixel, index, 1, seed))};
}

Ray Renderer::camera_ray(const Aim& aim, const Vec2& shift, double pivot) const {
  const Ray moved = camera_.ray(aim.position + shift, aim.lens);
  if (pivot == 0) return moved;
  const Ray ray = camera_.ray(aim.position, aim.lens);
  const Vec3 stays = ray.o + pivot * ray.d;
  const Vec3 start = ray.o + (moved.o + pivot * moved.d - stays);
  return {start, glm::normalize(stays - start)};
}

SampleId Renderer::id(int x, int y, uint32_t index) const {
  return {uint32_t(y) * uint32_t(scene_.image.width) + uint32_t(x), index};
}

AuxiliarySample Renderer::auxiliary(int x, int y, uint32_t index) const {
  const Aim aim = this->aim(x, y, index);
  if (!camera_.sees(aim.position)) return {};
  return path_auxiliary(tracer_, id(x, y, index), camera_ray(aim, {0, 0}, 0), media_);
}

PixelSample Renderer::sample(int x, int y, uint32_t index, Vec2 shift,
                             const rounding::Displacement& displacement, const Observer& observer) const {
  const Aim aim = this->aim(x, y, index);
  if (!camera_.sees(aim.position + shift, aim.lens)) return {};
  const Ray ray = camera_ray(aim, shift, displacement.pivot);
  const IntegratorType type = scene_.render.integrator;
  observer.ray(RayKind::eye, ray, 0);
  PixelSample sample = integrator(type).sample(tracer_, id(x, y, index), ray, media_, displacement, observer);
  if (traits_of(type).ways > 0) sample.flags |= flags_;
  return sample;
}

FirstHit Renderer::first_hit(int x, int y, Vec2 shift, const rounding::Displacement& displacement) const {
  return hit({Vec2(x, y) + Vec2(0.5)}, id(x, y, 0), shift, displacement);
}

FirstHit Renderer::first_hit_of_sample(int x, int y, uint32_t index, Vec2 shift,
                                       const rounding::Displacement& displacement) const {
  return hit(aim(x, y, index), id(x, y, index), shift, displacement);
}

FirstHit Renderer::hit(const Aim& aim, const SampleId& id, const Vec2& shift,
                       const rounding::Displacement& displacement) const {
  FirstHit result;
  if (!camera_.sees(aim.position + shift, aim.lens)) return result;
  Ray ray = camera_ray(aim, shift, displacement.pivot);
  ray.alpha_key = alpha_key(id.pixel, id.index, 0, 0, scene_.render.seed);
  const auto hit = tracer_.trace(ray, result.flags, displacement.coincident);
  if (!hit) return result;
  const SurfacePoint surface = tracer_.surface(ray, *hit);
  result.t = hit->at.t;
  result.position = surface.position;
  result.normal = surface.normal;
  result.normal_geometric = surface.normal_geometric;
  result.cosine = -glm::dot(ray.d, surface.normal_geometric);
  result.uv = surface.uv;
  result.primitive = int32_t(hit->primitive);
  result.material = hit->material;
  result.t_scale = tracer_.t_scale(ray, *hit, surface);
  return result;
}

double Renderer::rounding(int x, int y, double t) const {
  // A direction takes some five roundings, and the point where it hits a surface takes a few more.
  constexpr double roundings = 8 * 0x1p-24;
  const Ray ray = camera_.ray(Vec2(x, y) + Vec2(0.5)), next = camera_.ray(Vec2(x, y) + Vec2(1.5, 0.5));
  const double distance = std::isfinite(t) ? t : 1;
  const Vec3 point = ray.o + distance * ray.d;
  return roundings * glm::length(point - scene_.camera.eye) / glm::length(next.o + distance * next.d - point);
}

double Renderer::pivot(int x, int y, uint32_t which) const {
  const double t = first_hit(x, y).t;
  return std::isfinite(t) ? t * (1 + std::ldexp(1.0, -1 - int(which % 8))) : 0;
}

}  // namespace eyeray::engine::reference
