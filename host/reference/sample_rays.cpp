#include "host/reference/sample_rays.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/core/termination.hpp"
#include "host/reference/bsdf.hpp"
#include "host/reference/context_on.hpp"
#include "host/reference/crossings.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/medium_extent.hpp"
#include "host/reference/rng.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::reference {

Vec3 Interaction::refracted() const {
  if (ior_before == ior_beyond) return d;
  const double eta = ior_before / ior_beyond;
  const double cos2_squared = 1 - eta * eta * (1 - cos_view * cos_view);
  return glm::normalize(eta * d + (eta * cos_view - std::sqrt(std::max(0.0, cos2_squared))) * surface.normal);
}

Vec3 transmittance(const Medium& medium, double length) {
  const Vec3 extinction = medium.absorption + medium.scattering;
  Vec3 left(1);
  for (int c = 0; c < 3; ++c)
    if (extinction[c] > 0) left[c] = std::exp(-extinction[c] * length);
  return left;
}

Medium SampleRays::medium(const MediaStack& media) const {
  return media.top() < 0 ? scene_.medium : *scene_.materials[size_t(media.top())]->medium();
}

double SampleRays::medium_length(const MediaStack& media, const Ray& ray, double t) const {
  return media.top() < 0 ? reference::medium_length(scene_.medium_extent, ray, t) : t;
}

double SampleRays::medium_distance(const MediaStack& media, const Ray& ray, double length) const {
  return media.top() < 0 ? reference::medium_distance(scene_.medium_extent, ray, length) : length;
}

Ray SampleRays::start_ray(const Ray& ray) {
  if (displacement_.share == 0) return ray;
  Vec3 offset;
  for (uint32_t i = 0; i < 3; ++i) offset[int(i)] = 2 * random(displacement_.seed, spawned_, i, 0) - 1;
  const Ray started{ray.o + displacement_.share * glm::length(ray.o - scene_.camera.eye) * offset,
                    rounded(ray.d)};
  ++spawned_;
  return started;
}

Ray SampleRays::spawn_ray(const SurfacePoint& point, const Vec3& d, Leaving leaving) {
  if (displacement_.textures != rounding::TextureChoice::at_hit)
    return {spawn_origin(point, d, 0, false, leaving), d};
  const Vec3 from_eye = glm::abs(point.position - scene_.camera.eye);
  const double least =
      displacement_.off * displacement_.share * glm::dot(glm::abs(point.normal_geometric), from_eye);
  Ray ray{spawn_origin(point, d, least, displacement_.along_normal, leaving), d};
  if (displacement_.share == 0) return ray;

  Vec3 offset;
  for (uint32_t i = 0; i < 3; ++i) offset[int(i)] = 2 * random(displacement_.seed, spawned_, i, 0) - 1;
  // Only triangles have known edges. On any other shape, one ray in eight is displaced as if it were near an
  // edge.
  if (displacement_.room > 0 && random(displacement_.seed, spawned_, 7, 0) < 0.125 &&
      point.weights == Vec3(0))
    offset *= displacement_.room / displacement_.share;
  ++spawned_;
  offset -= glm::dot(offset, point.normal_geometric) * point.normal_geometric;
  ray.o += displacement_.share * glm::length(from_eye) * offset;
  ray.o += way_inside(point, displacement_.room * magnitude(from_eye));
  return ray;
}

Ray SampleRays::spawn_to_light(const SurfacePoint& point, const Vec3& l, Leaving leaving, double& distance) {
  Ray ray = spawn_ray(point, l, leaving);
  if (point.lift.x < 0 || !std::isfinite(distance)) return ray;
  const Vec3 way = point.position + distance * l - ray.o;
  distance = glm::length(way);
  ray.d = way / distance;
  return ray;
}

Vec3 SampleRays::end_before(const Vec3& point, const Vec3& normal, const Vec3& l) const {
  const double off = displacement_.share * glm::dot(glm::abs(normal), glm::abs(point - scene_.camera.eye));
  return point + normal * (glm::dot(l, normal) < 0 ? off : -off);
}

Vec3 SampleRays::rounded(const Vec3& d) const {
  if (displacement_.share == 0) return d;
  Vec3 offset;
  for (uint32_t i = 0; i < 3; ++i) offset[int(i)] = 2 * random(displacement_.seed, spawned_, 4 + i, 0) - 1;
  return glm::normalize(d + displacement_.share * offset);
}

Vec3 SampleRays::surroundings(const Vec3& d) const {
  return scene_.environment ? environment_radiance(*scene_.environment, rounded(d))
                            : scene_.render.background;
}

// The largest error that float32 makes in the cosine between a surface's normal and the direction to a point
// at `distance`.
double SampleRays::cosine_rounding(const SurfacePoint& point, double distance) const {
  if (displacement_.share == 0) return 0;
  return displacement_.share * (1 + glm::length(point.position - scene_.camera.eye) / distance);
}

// A random share of cosine_rounding(), positive or negative.
double SampleRays::tilt(const SurfacePoint& point, double distance) const {
  return cosine_rounding(point, distance) * (2 * random(displacement_.seed, spawned_, 3, 0) - 1);
}

bool SampleRays::faces(const SurfacePoint& point, const Vec3& l, double distance) const {
  const double by = tilt(point, distance);
  return glm::dot(point.normal, l) + by > 0 && glm::dot(point.normal_side, l) + by > 0;
}

bool SampleRays::is_before(const SurfacePoint& point, const Vec3& l, double distance) const {
  return glm::dot(point.normal_side, l) + tilt(point, distance) > 0;
}

double SampleRays::shadow(const Ray& ray, double t_end) {
  ++rays_;
  // If a light is far away, float32 cannot resolve how near to it an occluder stands.
  const double short_of = walks_at_random(scene_.render.integrator) ? displacement_.share : 0;
  return tracer_.transmittance(ray, t_end * (1 - short_of), flags_);
}

Bsdf SampleRays::bsdf(const Material& material, const ScatteringContext& context,
                      const Scattering& scattering) const {
  Bsdf bsdf = material.bsdf(context, scattering);
  // Without interfaces a material with the same index on both sides is glass like any other.
  if (tracer_.any_interface() && context.ior_from == context.ior_to)
    bsdf.crossed = std::exchange(bsdf.transmitted, Vec3(0));
  return bsdf;
}

Vec3 SampleRays::through_panes(Ray ray, double t_end, bool has_extent, MediaStack media) {
  ++rays_;
  Vec3 left(1);
  for (int crossed = 0;; ++crossed) {
    const auto hit = tracer_.trace(ray, flags_, displacement_.coincident);
    const bool arrives = !hit || hit->at.t >= t_end;
    const Medium before = medium(media);
    if (tracer_.any_interface())
      left *= transmittance(before, medium_length(media, ray, arrives ? t_end : hit->at.t));
    if (arrives) return left;
    if (crossed == most_passed) flags_ |= iteration_limit;
    if (crossed == (has_extent ? most_panes : most_passed)) return Vec3(0);
    SurfacePoint surface = tracer_.surface(ray, *hit);
    const bool front = glm::dot(ray.d, surface.normal_geometric) <= 0;
    if (!front) turn_over(surface);
    const Material& material = *scene_.materials[size_t(hit->material)];
    if (fills(material, scene_.render.integrator)) {
      if (!front)
        media.remove(hit->material);
      else
        media.push(hit->material);
    }
    const double cosine = std::clamp(-glm::dot(ray.d, surface.normal), 0.0, 1.0);
    const LocalFrame frame = LocalFrame::of(surface);
    const ScatteringContext context{context_on(surface), cosine,        before.ior,
                                    medium(media).ior,   surface.color, frame.into(surface.coat_normal)};
    left *= ViewedBsdf(bsdf(material, context, material.scattering(context)), frame.seen(-ray.d)).passed();
    if (left == Vec3(0)) return left;
    Ray next = spawn_ray(surface, ray.d);
    next.alpha_key = ray.alpha_key;
    t_end -= glm::dot(next.o - ray.o, ray.d);
    ray = next;
  }
}

// The scattering at the hit, or with the darkest or brightest textures that displaced rays find. A ray may
// run along the border of two checks through many walls of glass, and be rounded to either side at each.
// These combinations are too many to try. Their bounds are known without that, since no colour falls where a
// texture's rises.
Scattering SampleRays::scattering(const Ray& ray, const Hit& hit, const SurfacePoint& point,
                                  ScatteringContext context) const {
  const Material& material = *scene_.materials[size_t(hit.material)];
  Scattering result = material.scattering(context);
  if (displacement_.textures == rounding::TextureChoice::at_hit) return result;

  const auto choose = [&](Vec3& value, const Vec3& other) {
    value = displacement_.textures == rounding::TextureChoice::darkest ? glm::min(value, other)
                                                                       : glm::max(value, other);
  };
  const Vec3 u = glm::normalize(glm::cross(ray.d, std::abs(ray.d.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 v = glm::cross(ray.d, u);
  const double offset = displacement_.share * glm::length(point.position - scene_.camera.eye);
  for (int i = 0; i < 8; ++i) {
    const Ray moved{ray.o + offset * (std::cos(i * M_PI / 4) * u + std::sin(i * M_PI / 4) * v), ray.d,
                    ray.alpha_key};
    const auto other_hit = tracer_.trace(moved);
    if (!other_hit || other_hit->primitive != hit.primitive) continue;
    const SurfacePoint other_point = tracer_.surface(moved, *other_hit);
    context.point = context_on(other_point);
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

std::optional<Hit> SampleRays::trace(const Ray& ray) {
  stop_if_interrupted();
  ++rays_;
  return tracer_.trace(ray, flags_, takes_farther());
}

// True if the farther of two coincident surfaces is hit. With displaced random numbers this is random for
// each ray, since float32 may take either.
bool SampleRays::takes_farther() const {
  const bool tossed = displacement_.numbers == 0 || random(displacement_.numbers, rays_, 0, 1) < 0.5;
  return displacement_.coincident && tossed;
}

Interaction SampleRays::interaction(const Ray& ray, const Hit& hit, const MediaStack& media,
                                    const Vec3& throughput, const Vec3& dimming) {
  ++hits_;

  // Turn the surface to the viewer. If the ray runs along the surface, float32 may see either side.
  Interaction at{.surface = tracer_.surface(ray, hit), .d = ray.d, .primitive = hit.primitive};
  observer_.hit(tracer_, ray, hit, at.surface);
  const double cosine = glm::dot(at.d, at.surface.normal_geometric);
  const bool along = std::abs(cosine) < cosine_rounding(at.surface, hit.at.t);
  const bool front = (cosine < 0) != (along && displacement_.along_normal);
  if (!front) turn_over(at.surface);
  at.cos_view = std::clamp(-glm::dot(at.d, at.surface.normal), 0.0, 1.0);

  // List the media that adjoin here.
  const Material& material = *scene_.materials[size_t(hit.material)];
  const Medium before = medium(media);
  at.has_medium = fills(material, scene_.render.integrator);
  at.media_beyond = media;
  if (at.has_medium) {
    if (!front) {
      at.media_beyond.remove(hit.material);
    } else if (!at.media_beyond.push(hit.material)) {
      flags_ |= media_overflow;
    }
  }
  at.dimming = dimming;
  const Vec3 light = walks_at_random(scene_.render.integrator) ? throughput * dimming : Vec3(1);
  at.ior_before = before.index(light);
  at.ior_beyond = medium(at.media_beyond).index(light);
  const ScatteringContext context{
      context_on(at.surface), at.cos_view,      at.ior_before,
      at.ior_beyond,          at.surface.color, LocalFrame::of(at.surface).into(at.surface.coat_normal)};
  at.scattering = scattering(ray, hit, at.surface, context);
  if (!front && material.emits_in_front) at.scattering.emitted = Vec3(0);
  if (walks_at_random(scene_.render.integrator)) at.bsdf = bsdf(material, context, at.scattering);

  observer_.value("ior", Vec2(at.ior_before, at.ior_beyond));
  observer_.value("ambient", at.scattering.ambient);
  observer_.value("diffuse", at.scattering.diffuse);
  observer_.value("specular", at.scattering.specular);
  observer_.value("reflected", at.scattering.reflected);
  observer_.value("transmitted", at.scattering.transmitted);
  observer_.value("emitted", at.scattering.emitted);
  observer_.value("throughput", throughput * at.dimming);
  return at;
}

void SampleRays::decided(Event kind, uint64_t value) {
  const uint32_t event = event_of(kind, value);
  trail_ = with_event(trail_, event);
  observer_.event(event);
}

PixelSample SampleRays::sample(const Vec3& color) const {
  return {color, rays_, hits_, flags_, reflected, refracted, total_reflections, trail_, cut_off, background};
}

}  // namespace eyeray::engine::reference
