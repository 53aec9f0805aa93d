// The light from light sources that a vertex of a path scatters.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/reference/emitter_sample.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/light_disk.hpp"
#include "host/reference/path_sample.hpp"
#include "host/reference/phase.hpp"

namespace eyeray::engine::reference {

// This form also holds for an infinite density, which a point seen edge-on has.
double power_heuristic(double p, double q) {
  return 1 / (1 + (q / p) * (q / p));
}

LitPoint lit_point(const Interaction& at) {
  const bool all_around = at.bsdf.glass + at.bsdf.thin + at.bsdf.translucent != Vec3(0) || at.in_medium();
  return {at.surface.position, all_around ? std::nullopt : std::optional(at.surface.normal)};
}

Leaving leaving(const Interaction& at, const Vec3& d) {
  return glm::dot(at.surface.normal_side, d) > 0 ? Leaving::in_front : Leaving::behind;
}

// The surface's own light, less the part that shadow rays to it have brought already.
Vec3 PathSample::emitted(const Interaction& at) const {
  const Vec3& light = at.scattering.emitted;
  const LightChoice& choice = tracer_.light_choice();
  if (density_ == 0) return light;
  const auto found = std::ranges::lower_bound(choice.emitters, at.primitive, {}, &Emitter::primitive);
  if (found == choice.emitters.end() || found->primitive != at.primitive) return light;
  const double share =
      (1 - environment_share()) *
      light_share(choice, chosen_at_, scene_.lights.size() + size_t(found - choice.emitters.begin()));
  const EmitterSample point{at.surface.position, at.surface.normal_geometric};
  return light * power_heuristic(density_, share * emitter_density(found->form, vertex_, point));
}

// The probability of choosing the environment, and not a light.
double PathSample::environment_share() const {
  return environment_numbers(scene_.environment.get(), !tracer_.light_choice().ends.empty()) * 0x1p-24;
}

// The light seen by a path that hits nothing, less the part that shadow rays have brought already.
Vec3 PathSample::missed(const Vec3& d) const {
  Vec3 light = rays_.surroundings(d);
  const double share = environment_share();
  const auto weight = [&](double density) { return density_ > 0 ? power_heuristic(density_, density) : 1; };
  if (share > 0) light *= weight(share * environment_density(*scene_.environment, rays_.rounded(d)));
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const Illumination disk = scene_.lights[i]->illuminate(Vec3(0));
    if (disk.angle == 0 || !in_disk(disk, rays_.rounded(d))) continue;
    light += disk_radiance(disk) * weight((1 - share) * tracer_.light_choice().share(i) * disk_density(disk));
  }
  return light;
}

std::optional<Arriving> PathSample::arriving_from_around(const Interaction& at) {
  const auto [l, by_angle] = sample_environment(*scene_.environment, pair(emitter_pair));
  const double density = environment_share() * by_angle;
  return Arriving{l,
                  rays_.spawn_ray(at.surface, l, leaving(at, l)),
                  std::numeric_limits<double>::infinity(),
                  rays_.surroundings(l) / density,
                  density,
                  uint64_t(-1)};
}

// The light that arrives at the point from one randomly chosen light. Lights have classic units: intensity 1
// counts as π.
std::optional<Arriving> PathSample::arriving(const Interaction& at) {
  const LightChoice& choice = tracer_.light_choice();
  const Vec2 random = pair(light_pair);
  if (random.y < environment_share()) return arriving_from_around(at);
  if (choice.ends.empty()) return std::nullopt;
  const auto pick = pick_light(choice, lit_point(at), random.x);
  if (!pick) return std::nullopt;
  const size_t light = pick->light;
  const double share = (1 - environment_share()) * pick->share;
  const Vec3& p = at.surface.position;
  if (light < scene_.lights.size()) {
    const Illumination arriving = scene_.lights[light]->illuminate(p);
    double distance = arriving.distance;
    if (arriving.angle > 0) {
      const Vec3 l = disk_direction(arriving, pair(emitter_pair));
      const double density = share * disk_density(arriving);
      const Ray ray = rays_.spawn_to_light(at.surface, l, leaving(at, l), distance);
      return Arriving{l, ray, distance, disk_radiance(arriving) / density, density, light};
    }
    const Ray ray = rays_.spawn_to_light(at.surface, arriving.l, leaving(at, arriving.l), distance);
    return Arriving{arriving.l, ray, distance, M_PI / share * arriving.color, 0, light};
  }
  const Emitter& emitter = choice.emitters[light - scene_.lights.size()];
  // A flat emitter does not light itself.
  if (emitter.primitive == at.primitive && is_flat(emitter.form)) return std::nullopt;
  const EmitterSample point = sample_emitter(emitter.form, p, pair(emitter_pair));
  const Vec3 l = glm::normalize(point.position - p);
  Ray ray = rays_.spawn_ray(at.surface, l, leaving(at, l));
  const Vec3 way = rays_.end_before(point.position, point.normal, l) - ray.o;
  ray.d = glm::normalize(way);
  // The ray from a lifted start may reach the emitter from its other side. Then it ends behind the emitter,
  // which blocks it.
  const bool same_side = glm::dot(l, point.normal) * glm::dot(way, point.normal) > 0;
  const double end = same_side ? 1 - 1e-9 : 1 + 1e-9;
  const double density = share * emitter_density(emitter.form, p, point);
  return Arriving{
      l, ray, glm::length(way) * end, emitter_radiance(scene_, emitter, point, p) / density, density, light};
}

// The light that a vertex scatters from one light to the viewer. `scattered`: the vertex's BSDF or phase
// function. The shadow ray leaves `media` only through panes and interfaces.
Vec3 PathSample::direct(const Interaction& at, const Arriving& light, const BsdfValue& scattered,
                        const MediaStack& media) {
  const double weight = light.density > 0 ? power_heuristic(light.density, scattered.density) : 1;
  // If the scene has interfaces, through_panes() applies the transmittance between them.
  const Vec3 left =
      tracer_.any_interface()
          ? Vec3(1)
          : transmittance(rays_.medium(media), rays_.medium_length(media, light.ray, light.distance));
  const Vec3 contribution = light.radiance * left * scattered.value * weight;
  if (contribution == Vec3(0)) return Vec3(0);
  const bool beyond = glm::dot(light.ray.d, at.surface.normal_side) < 0;
  const MediaStack& passed = beyond && !at.in_medium() ? at.media_beyond : media;
  const Ray ray = with_key(light.ray, 1);
  const Vec3 seen = any_pane_ ? rays_.through_panes(ray, light.distance, light.density > 0, passed)
                              : Vec3(rays_.shadow(ray, light.distance));
  observer_.ray(RayKind::shadow, ray, depth_, 0);
  observer_.value("contribution", contribution);
  observer_.value("visibility", seen.x);
  observer_.back(depth_);
  light_event_ = 2 * (light.light + 2) + (seen != Vec3(0) ? 1 : 0);
  return seen * contribution;
}

Vec3 PathSample::direct_on(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                           const MediaStack& media) {
  if (bsdf.black() || depth_ > scene_.render.max_depth) return Vec3(0);
  const auto light = arriving(at);
  if (!light || light->radiance == Vec3(0)) return Vec3(0);
  const Vec3 i = frame.into(light->l);
  const bool before = rays_.is_before(at.surface, light->l, light->distance);
  const BsdfValue scattered = bsdf.at(i, before);
  if (scattered.value == Vec3(0)) return Vec3(0);
  return direct(at, *light, scattered, before ? media : at.media_beyond);
}

Vec3 PathSample::direct_in(const Interaction& at, const MediaStack& media) {
  if (depth_ > scene_.render.max_depth) return Vec3(0);
  const auto light = arriving(at);
  if (!light || light->radiance == Vec3(0)) return Vec3(0);
  const double phase = phase_value(rays_.medium(media).anisotropy, glm::dot(at.d, light->l));
  return direct(at, *light, {Vec3(phase), phase}, media);
}

}  // namespace eyeray::engine::reference
