// Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980; recursive, as the paper has
// it.
#include "host/reference/integrator.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/termination.hpp"
#include "host/reference/crossings.hpp"
#include "host/reference/rng.hpp"

namespace eyeray::reference {

extern const Integrator whitted_integrator;

namespace {

constexpr std::string_view manual =
    "Whitted's ray tracing: every light's shadow at every surface, and reflections and refractions of it, "
    "each followed by itself.";

// A ray on its way, and what it is worth.
struct Path {
  Ray ray;
  MediaStack media;
  int depth;        // reflections and refractions so far
  Vec3 throughput;  // what its colour will be multiplied by in the pixel
};

// A hit, seen from the viewer's side: both normals towards where the ray came from.
struct View {
  SurfacePoint surface;
  Vec3 d;           // unit, of the ray
  double cos_view;  // between the shading normal and the way back, in [0, 1]
};

class Recursion {
 public:
  Recursion(const Tracer& tracer, const RayOffset& ray_offset, const Observer& observer)
      : tracer_(tracer), scene_(tracer.scene()), ray_offset_(ray_offset), observer_(observer) {}

  Vec3 radiance(const Path& path);

  uint32_t rays = 0;
  uint32_t hits = 0;
  uint32_t flags = 0;
  uint32_t reflected = 0;
  uint32_t refracted = 0;
  uint32_t total_reflections = 0;

 private:
  Vec3 direct(const View& view, const Scattering& scattering, int depth);
  Vec3 child(RayKind kind, const Path& path, const View& view, const Vec3& d, const MediaStack& media,
             const Vec3& share);
  Scattering scattering(const Ray& ray, const Hit& hit, const SurfacePoint& point,
                        ScatteringContext context) const;
  Medium medium(const MediaStack& media) const;
  void observe(const Vec2& ior, const Scattering& scattering, const Vec3& throughput) const;
  Ray spawn_ray(const SurfacePoint& point, const Vec3& d);
  double cosine_rounding(const SurfacePoint& point, double distance) const;

  const Tracer& tracer_;
  const Scene& scene_;
  RayOffset ray_offset_;
  const Observer& observer_;
  uint32_t spawned_ = 0;
};

// The vacuum where no medium is.
Medium Recursion::medium(const MediaStack& media) const {
  return media.top() < 0 ? Medium{} : *scene_.materials[size_t(media.top())]->medium();
}

Ray Recursion::spawn_ray(const SurfacePoint& point, const Vec3& d) {
  if (ray_offset_.textures != TextureChoice::at_hit) return {spawn_origin(point, d), d};
  const Vec3 from_eye = glm::abs(point.position - scene_.camera.eye);
  const double least = ray_offset_.share * glm::dot(glm::abs(point.normal_geometric), from_eye);
  Ray ray{spawn_origin(point, d, least, ray_offset_.along_normal), d};
  if (ray_offset_.share == 0) return ray;

  Vec3 aside;
  for (uint32_t i = 0; i < 3; ++i) aside[int(i)] = 2 * random(ray_offset_.seed, spawned_, i, 0) - 1;
  ++spawned_;
  aside -= glm::dot(aside, point.normal_geometric) * point.normal_geometric;
  ray.o += ray_offset_.share * glm::length(from_eye) * aside;
  return ray;
}

// What float32 may add at most to the cosine between a surface and what lies at that distance from it.
double Recursion::cosine_rounding(const SurfacePoint& point, double distance) const {
  if (ray_offset_.share == 0) return 0;
  return ray_offset_.share * (1 + glm::length(point.position - scene_.camera.eye) / distance);
}

// A ray may run along the border of two checks through many walls of glass, and be rounded to either side at
// each: of so many ways the bounds are known without trying them, since no colour falls where a texture's
// rises.
Scattering Recursion::scattering(const Ray& ray, const Hit& hit, const SurfacePoint& point,
                                 ScatteringContext context) const {
  const Material& material = *scene_.materials[size_t(hit.material)];
  Scattering result = material.scattering(context);
  if (ray_offset_.textures == TextureChoice::at_hit) return result;

  const auto choose = [&](Vec3& value, const Vec3& other) {
    value = ray_offset_.textures == TextureChoice::darkest ? glm::min(value, other) : glm::max(value, other);
  };
  const Vec3 u = glm::normalize(glm::cross(ray.d, std::abs(ray.d.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 v = glm::cross(ray.d, u);
  const double aside = ray_offset_.share * glm::length(point.position - scene_.camera.eye);
  for (int i = 0; i < 8; ++i) {
    const Ray moved{ray.o + aside * (std::cos(i * M_PI / 4) * u + std::sin(i * M_PI / 4) * v), ray.d};
    const auto other_hit = tracer_.trace(moved);
    if (!other_hit || other_hit->primitive != hit.primitive) continue;
    context.uv = tracer_.surface(moved, *other_hit).uv;
    const Scattering other = material.scattering(context);
    choose(result.ambient, other.ambient);
    choose(result.diffuse, other.diffuse);
    choose(result.specular, other.specular);
    choose(result.reflected, other.reflected);
    choose(result.transmitted, other.transmitted);
    choose(result.emitted, other.emitted);
  }
  return result;
}

// d of a ray that is bent at the boundary from ior n1 to n2; there is no total reflection.
Vec3 refract(const View& view, double n1, double n2) {
  if (n1 == n2) return view.d;
  const double eta = n1 / n2;
  const double cos2_squared = 1 - eta * eta * (1 - view.cos_view * view.cos_view);
  return glm::normalize(eta * view.d +
                        (eta * view.cos_view - std::sqrt(std::max(0.0, cos2_squared))) * view.surface.normal);
}

Vec3 Recursion::radiance(const Path& path) {
  stop_if_interrupted();
  ++rays;
  const auto hit = tracer_.trace(path.ray, flags, ray_offset_.coincident);
  if (!hit) {
    observer_.miss(path.throughput, scene_.render.background);
    return scene_.render.background;
  }
  ++hits;

  // Turn the surface to the viewer. Float32 may see either side of one that the ray runs along.
  View view{tracer_.surface(path.ray, *hit), path.ray.d, 0};
  observer_.hit(tracer_, path.ray, *hit, view.surface);
  const double cosine = glm::dot(view.d, view.surface.normal_geometric);
  const bool along = std::abs(cosine) < cosine_rounding(view.surface, hit->at.t);
  const bool front = (cosine < 0) != (along && ray_offset_.along_normal);
  if (!front) {
    view.surface.normal_geometric = -view.surface.normal_geometric;
    view.surface.normal = -view.surface.normal;
  }
  view.cos_view = std::clamp(-glm::dot(view.d, view.surface.normal), 0.0, 1.0);

  // Say which media hit here.
  const Material& material = *scene_.materials[size_t(hit->material)];
  const Medium before = medium(path.media);
  MediaStack beyond = path.media;
  if (material.medium()) {
    if (!front) {
      beyond.remove(hit->material);
    } else if (!beyond.push(hit->material)) {
      flags |= media_overflow;
    }
  }
  const double ior_beyond = medium(beyond).ior;
  const Scattering scattering =
      this->scattering(path.ray, *hit, view.surface,
                       {view.surface.uv, view.cos_view, before.ior, ior_beyond, view.surface.color});

  // Add up the light that the point scatters, mirrors and lets through, and dim it on its way here.
  Path arrived = path;
  const Vec3 dimming = glm::exp(-before.absorption * hit->at.t);
  arrived.throughput *= dimming;
  observe(Vec2(before.ior, ior_beyond), scattering, arrived.throughput);
  Vec3 color = direct(view, scattering, path.depth);
  observer_.value("light", color);
  const Vec3 mirrored = view.d + 2 * view.cos_view * view.surface.normal;
  color +=
      child(RayKind::reflected, arrived, view, glm::normalize(mirrored), path.media, scattering.reflected);
  if (scattering.transmitted != Vec3(0))
    color += child(RayKind::refracted, arrived, view, refract(view, before.ior, ior_beyond), beyond,
                   scattering.transmitted);
  else if (material.medium() && path.depth < scene_.render.max_depth)
    ++total_reflections;
  return dimming * color;
}

void Recursion::observe(const Vec2& ior, const Scattering& scattering, const Vec3& throughput) const {
  observer_.value("ior", ior);
  observer_.value("ambient", scattering.ambient);
  observer_.value("diffuse", scattering.diffuse);
  observer_.value("specular", scattering.specular);
  observer_.value("reflected", scattering.reflected);
  observer_.value("transmitted", scattering.transmitted);
  observer_.value("emitted", scattering.emitted);
  observer_.value("throughput", throughput);
}

// The part of a surface's colour that comes from the ray's child into direction d; black when it is cut off.
Vec3 Recursion::child(RayKind kind, const Path& path, const View& view, const Vec3& d,
                      const MediaStack& media, const Vec3& share) {
  const Vec3 throughput = path.throughput * share;
  const double most = std::max({throughput.x, throughput.y, throughput.z});
  if (path.depth >= scene_.render.max_depth || !(most > scene_.render.min_throughput)) return Vec3(0);
  ++(kind == RayKind::reflected ? reflected : refracted);
  const Path next{spawn_ray(view.surface, d), media, path.depth + 1, throughput};
  observer_.ray(kind, next.ray, next.depth);
  return share * radiance(next);
}

// Its own light, the scene's ambient one, and that of each light which stands before the surface and is seen
// from it.
Vec3 Recursion::direct(const View& view, const Scattering& scattering, int depth) {
  const Vec3 n = view.surface.normal;
  Vec3 color = scattering.emitted + scattering.ambient * scene_.render.ambient;
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const auto [l, arriving, distance] = scene_.lights[i]->illuminate(view.surface.position);
    // A light in the plane of the surface may be before or behind it.
    const double cosine = glm::dot(n, l);
    const double tilt =
        cosine_rounding(view.surface, distance) * (2 * random(ray_offset_.seed, spawned_, 3, 0) - 1);
    if (!(cosine + tilt > 0 && glm::dot(view.surface.normal_geometric, l) + tilt > 0)) continue;
    ++rays;
    const Ray ray = spawn_ray(view.surface, l);
    const double seen = tracer_.transmittance(ray, distance, flags);
    if (seen == 0 && !observer_) continue;

    const double lobe =
        scattering.blinn ? glm::dot(n, glm::normalize(l - view.d)) : glm::dot(2 * cosine * n - l, -view.d);
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

PixelSample whitted(const Tracer& tracer, const Ray& ray, const MediaStack& media,
                    const RayOffset& ray_offset, const Observer& observer) {
  Recursion recursion(tracer, ray_offset, observer);
  const Vec3 color = recursion.radiance({ray, media, 0, Vec3(1)});
  return {color,
          recursion.rays,
          recursion.hits,
          recursion.flags,
          recursion.reflected,
          recursion.refracted,
          recursion.total_reflections};
}

}  // namespace

extern const Integrator whitted_integrator{.manual = manual, .sample = whitted};

}  // namespace eyeray::reference
