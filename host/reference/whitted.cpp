// Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980. The code is recursive, as in
// the paper.
#include <algorithm>
#include <cmath>

#include "host/reference/integrator.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sample_rays.hpp"

namespace eyeray::engine::reference {

extern const Integrator whitted_integrator;

namespace {

constexpr std::string_view manual =
    "Whitted's ray tracing: shadow rays to every light from every surface, plus reflections and refractions, "
    "each traced by its own ray.";

// A ray to be traced, and its weight.
struct Path {
  Ray ray;
  MediaStack media;
  int depth;        // reflections and refractions so far
  Vec3 throughput;  // the factor of its colour in the pixel
};

class Recursion {
 public:
  Recursion(const Tracer& tracer, const SampleId& id, const rounding::Displacement& displacement,
            const Observer& observer)
      : rays(tracer, displacement, observer), scene_(tracer.scene()), id_(id), observer_(observer) {}

  Vec3 radiance(const Path& path);

  SampleRays rays;

 private:
  Vec3 missed(const Path& path);
  Vec3 direct(const Interaction& at, int depth);
  Vec3 child(RayKind kind, const Path& path, const Interaction& at, const Vec3& d, const MediaStack& media,
             const Vec3& share);

  // The key of alpha tests for ray `number` at that depth.
  uint32_t key(int depth, size_t number) const {
    return alpha_key(id_.pixel, id_.index, uint32_t(depth), uint32_t(number), scene_.render.seed);
  }

  const Scene& scene_;
  const SampleId id_;
  const Observer& observer_;
};

Vec3 Recursion::radiance(const Path& path) {
  Ray ray = path.ray;
  ray.alpha_key = key(path.depth, 0);
  const auto hit = rays.trace(ray);
  if (!hit) return missed(path);
  const Vec3 dimming = glm::exp(-rays.medium(path.media).absorption * hit->at.t);
  const Interaction at = rays.interaction(ray, *hit, path.media, path.throughput, dimming);

  // Add up the light that the point scatters, mirrors and lets through, and dim it on its way here.
  const Scattering& scattering = at.scattering;
  Path arrived = path;
  arrived.throughput *= at.dimming;
  Vec3 color = direct(at, path.depth);
  observer_.value("light", color);
  color += child(RayKind::reflected, arrived, at, at.mirrored(), path.media, scattering.reflected);
  if (scattering.transmitted != Vec3(0))
    color += child(RayKind::refracted, arrived, at, at.refracted(), at.media_beyond, scattering.transmitted);
  else if (at.has_medium && path.depth < scene_.render.max_depth)
    ++rays.total_reflections;
  return at.dimming * color;
}

// The light of a ray that hits nothing. A transparent picture leaves out that of a camera ray.
Vec3 Recursion::missed(const Path& path) {
  const bool straight = scene_.image.transparent && path.depth == 0;
  if (straight) rays.background = 1;
  const Vec3 light = straight ? Vec3(0) : rays.surroundings(path.ray.d);
  observer_.miss(path.throughput, light);
  return light;
}

// The part of a surface's colour that a child ray in direction d brings; black if that ray is cut off.
Vec3 Recursion::child(RayKind kind, const Path& path, const Interaction& at, const Vec3& d,
                      const MediaStack& media, const Vec3& share) {
  const Vec3 throughput = path.throughput * share;
  const double most = std::max({throughput.x, throughput.y, throughput.z});
  if (path.depth >= scene_.render.max_depth || !(most > scene_.render.min_throughput)) return Vec3(0);
  ++(kind == RayKind::reflected ? rays.reflected : rays.refracted);
  const Leaving side = kind == RayKind::reflected ? Leaving::in_front : Leaving::straight;
  const Path next{rays.spawn_ray(at.surface, d, side), media, path.depth + 1, throughput};
  observer_.ray(kind, next.ray, next.depth);
  return share * radiance(next);
}

// The surface's own light, the scene's ambient light, and the light of each light source that is in front of
// the surface and seen from it.
Vec3 Recursion::direct(const Interaction& at, int depth) {
  const Vec3 n = at.surface.normal;
  const Scattering& scattering = at.scattering;
  Vec3 color = scattering.emitted + scattering.ambient * scene_.render.ambient;
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    auto [l, arriving, distance, angle] = scene_.lights[i]->illuminate(at.surface.position);
    if (!rays.faces(at.surface, l, distance)) continue;
    Ray ray = rays.spawn_to_light(at.surface, l, Leaving::in_front, distance);
    ray.alpha_key = key(depth, 1 + i);
    const double seen = rays.shadow(ray, distance);
    if (seen == 0 && !observer_) continue;

    const double cosine = glm::dot(n, l);
    const double lobe =
        scattering.blinn ? glm::dot(n, glm::normalize(l - at.d)) : glm::dot(2 * cosine * n - l, -at.d);
    const double highlight = lobe > 0 ? std::pow(lobe, scattering.shininess) : 0;
    const Vec3 scattered = scattering.diffuse * std::max(0.0, cosine) + scattering.specular * highlight;
    color += seen * arriving * scattered;
    observer_.ray(RayKind::shadow, ray, depth, i);
    observer_.value("contribution", arriving * scattered);
    observer_.value("visibility", seen);
    observer_.back(depth);
  }
  return color;
}

PixelSample whitted(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                    const rounding::Displacement& displacement, const Observer& observer) {
  Recursion recursion(tracer, id, displacement, observer);
  const Vec3 color = recursion.radiance({ray, media, 0, Vec3(1)});
  return recursion.rays.sample(color);
}

}  // namespace

extern const Integrator whitted_integrator{.manual = manual, .sample = whitted};

}  // namespace eyeray::engine::reference
