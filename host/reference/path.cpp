// Kajiya: The Rendering Equation, SIGGRAPH 1986. Veach, Guibas: Optimally Combining Sampling Techniques for
// Monte Carlo Rendering, SIGGRAPH 1995. Arvo, Kirk: Particle Transport and Image Synthesis, SIGGRAPH 1990.
#include <algorithm>
#include <cmath>

#include "host/reference/bsdf.hpp"
#include "host/reference/emitter_sample.hpp"
#include "host/reference/environment.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/light_disk.hpp"
#include "host/reference/light_pick.hpp"
#include "host/reference/phase.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sample_rays.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::reference {

extern const Integrator path_integrator;

namespace {

constexpr std::string_view manual =
    "Path tracing: all light that surfaces scatter, reflect and refract among each other, by one random path "
    "a sample. Surfaces that emit are lights, and `background` is light from everywhere. What stands for "
    "such light in Whitted's pictures counts for nothing here: `ambient`, highlights (`specular`), `shadow` "
    "and `min_throughput`. `diffuse` beyond 1 counts as 1. `max_depth` surfaces are lit after the first.";

// What pairs of random numbers are for; of the vertices after the first, `pairs_a_vertex` further on each.
constexpr uint32_t scatter_pair = 4, direction_pair = 5, light_pair = 6, place_pair = 7, pairs_a_vertex = 4;
constexpr uint32_t first_flight_pair = 0x10000;  // of the vertices after the first one further on each
constexpr int first_roulette = 3;
constexpr double least_survival = 0.05;

double largest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

// The weight of a technique of density p beside one of density q. On edge a place is infinitely dense.
double power_heuristic(double p, double q) {
  return 1 / (1 + (q / p) * (q / p));
}

constexpr double least_cosine = 1e-4;  // towards the viewer: what bent normals turn away is seen edge-on

// A point's own frame: z is the normal towards where the ray came from.
class LocalFrame {
 public:
  explicit LocalFrame(const Interaction& at) : n_(at.surface.normal) {
    const auto [s, t] = tangents(n_);
    s_ = s;
    t_ = t;
    const Vec3 o = into(-at.d);
    viewer = glm::normalize(Vec3(o.x, o.y, std::max(o.z, least_cosine)));
  }

  Vec3 into(const Vec3& v) const { return {glm::dot(v, s_), glm::dot(v, t_), glm::dot(v, n_)}; }
  Vec3 out_of(const Vec3& v) const { return v.x * s_ + v.y * t_ + v.z * n_; }

  Vec3 viewer;

 private:
  Vec3 s_, t_, n_;
};

LitPoint lit_point(const Interaction& at) {
  const bool all_around = at.bsdf.glass + at.bsdf.thin != Vec3(0) || at.in_medium();
  return {at.surface.position, all_around ? std::nullopt : std::optional(at.surface.normal)};
}

// From a light: by direction l, along the ray where nothing stands before `distance`.
struct Arriving {
  Vec3 l;
  Ray ray;
  double distance;
  Vec3 radiance;   // divided by the density of the choice
  double density;  // by solid angle, with the light's choice; 0 of a light without extent
  uint64_t light;  // its number; of the environment −1
};

// How far a path gets through a medium: up to a point of it, or to what the ray hits.
struct Flight {
  double t;
  bool scattered;
  Vec3 weight;  // of the light that comes from there
};

// What comes through a medium.
Vec3 transmittance(const Medium& medium, double t) {
  const Vec3 extinction = medium.absorption + medium.scattering;
  Vec3 left(1);
  for (int c = 0; c < 3; ++c)
    if (extinction[c] > 0) left[c] = std::exp(-extinction[c] * t);
  return left;
}

class PathSample {
 public:
  PathSample(const Tracer& tracer, const SampleId& id, const RayOffset& ray_offset, const Observer& observer)
      : tracer_(tracer),
        scene_(tracer.scene()),
        id_(id),
        numbers_(ray_offset.numbers),
        rays_(tracer, ray_offset, observer),
        observer_(observer) {}

  PixelSample sample(Ray ray, MediaStack media);
  AuxiliarySample auxiliary(Ray ray, MediaStack media);

 private:
  Vec2 pair(uint32_t use) const { return pair_of(use + pairs_a_vertex * surfaces()); }
  Vec2 pair_of(uint32_t number) const {
    Vec2 pair = sampler(scene_.image.pattern).pair(id_.pixel, id_.index, number, scene_.render.seed);
    // Moved, where it is asked what float32 makes of numbers that are near to a decision.
    if (numbers_ != 0)
      for (uint32_t i = 0; i < 2; ++i)
        pair[int(i)] = std::clamp(pair[int(i)] + std::floor(9 * random(numbers_, number, i, 0) - 4) * 0x1p-24,
                                  0.0, 1 - 0x1p-24);
    return pair;
  }
  // That the path has come through.
  uint32_t surfaces() const { return uint32_t(depth_ + all_panes_); }
  Flight fly(const MediaStack& media, const std::optional<Hit>& hit) const;
  Interaction scattered_at(const Ray& ray, double t) const;
  std::optional<Ray> scatter_in(const Medium& medium, const Interaction& at);
  Vec3 emitted(const Interaction& at) const;
  Vec3 missed(const Vec3& d) const;
  double environment_share() const;
  std::optional<Arriving> arriving(const Interaction& at);
  std::optional<Arriving> arriving_from_around(const Interaction& at);
  Vec3 direct(const Interaction& at, const Arriving& light, const BsdfValue& scattered,
              const MediaStack& media);
  Vec3 direct_on(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                 const MediaStack& media);
  Vec3 direct_in(const Interaction& at, const MediaStack& media);
  std::optional<Ray> continued(RayKind kind, const Interaction& at, const Vec3& d, double chance,
                               uint32_t way, bool straight = false);
  std::optional<Ray> scatter(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                             MediaStack& media);

  const Tracer& tracer_;
  const Scene& scene_;
  const SampleId id_;
  const uint32_t numbers_;
  SampleRays rays_;
  const Observer& observer_;
  const bool any_pane_ = std::ranges::any_of(scene_.materials, &Material::thin);
  int depth_ = 0;
  int panes_ = 0, all_panes_ = 0;  // that the path has passed straight, since its last vertex and in all
  Vec3 vertex_{0};                 // its last, or the eye
  Vec3 throughput_{1};
  bool roulette_ = true;
  uint64_t asked_ = 0;    // by the last vertex: the value of its Event::light
  double density_ = 0;    // by solid angle, of the ray's direction; 0 where there was no choice
  LitPoint chosen_at_{};  // and where it was chosen
};

// A channel says how far, each as likely as it has light left; the density is that of all three.
Flight PathSample::fly(const MediaStack& media, const std::optional<Hit>& hit) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Medium medium = rays_.medium(media);
  const double end = hit ? hit->at.t : infinity;
  if (medium.scattering == Vec3(0)) {
    const bool open = !hit && media.top() >= 0;
    return {end, false, open ? Vec3(1) : transmittance(medium, end)};
  }
  const Vec3 extinction = medium.absorption + medium.scattering;
  const Vec2 chance = pair_of(first_flight_pair + surfaces());
  const Vec3 shares = throughput_ / (throughput_.x + throughput_.y + throughput_.z);
  const int channel = chance.x < shares.x ? 0 : chance.x < shares.x + shares.y ? 1 : 2;
  const double t = extinction[channel] > 0 ? -std::log1p(-chance.y) / extinction[channel] : infinity;
  if (t < end) {
    const Vec3 left = transmittance(medium, t);
    return {t, true, medium.scattering * left / glm::dot(shares, extinction * left)};
  }
  const Vec3 left = transmittance(medium, end);
  return {end, false, left / glm::dot(shares, left)};
}

// Its own light, less what shadow rays to it have brought already.
Vec3 PathSample::emitted(const Interaction& at) const {
  const Vec3& light = at.scattering.emitted;
  const LightChoice& choice = tracer_.light_choice();
  if (density_ == 0) return light;
  const auto found = std::ranges::lower_bound(choice.emitters, at.primitive, {}, &Emitter::primitive);
  if (found == choice.emitters.end() || found->primitive != at.primitive) return light;
  const double share =
      (1 - environment_share()) *
      light_share(choice, chosen_at_, scene_.lights.size() + size_t(found - choice.emitters.begin()));
  const EmitterSample place{at.surface.position, at.surface.normal_geometric};
  return light * power_heuristic(density_, share * emitter_density(found->form, vertex_, place));
}

// How likely the environment is chosen, and not a light.
double PathSample::environment_share() const {
  return environment_numbers(scene_.environment.get(), !tracer_.light_choice().ends.empty()) * 0x1p-24;
}

// What the path sees that hits nothing, likewise.
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
  const auto [l, by_angle] = sample_environment(*scene_.environment, pair(place_pair));
  const double density = environment_share() * by_angle;
  return Arriving{l,
                  rays_.spawn_ray(at.surface, l),
                  std::numeric_limits<double>::infinity(),
                  rays_.surroundings(l) / density,
                  density,
                  uint64_t(-1)};
}

// What one light, chosen at random, sends to the point. Classic units: one of intensity 1 is π times that.
std::optional<Arriving> PathSample::arriving(const Interaction& at) {
  const LightChoice& choice = tracer_.light_choice();
  const Vec2 chance = pair(light_pair);
  if (chance.y < environment_share()) return arriving_from_around(at);
  if (choice.ends.empty()) return std::nullopt;
  const auto pick = pick_light(choice, lit_point(at), chance.x);
  if (!pick) return std::nullopt;
  const size_t light = pick->light;
  const double share = (1 - environment_share()) * pick->share;
  const Vec3& p = at.surface.position;
  if (light < scene_.lights.size()) {
    const Illumination arriving = scene_.lights[light]->illuminate(p);
    if (arriving.angle > 0) {
      const Vec3 l = disk_direction(arriving, pair(place_pair));
      const double density = share * disk_density(arriving);
      return Arriving{
          l,    rays_.spawn_ray(at.surface, l), arriving.distance, disk_radiance(arriving) / density, density,
          light};
    }
    return Arriving{arriving.l,
                    rays_.spawn_ray(at.surface, arriving.l),
                    arriving.distance,
                    M_PI / share * arriving.color,
                    0,
                    light};
  }
  const Emitter& emitter = choice.emitters[light - scene_.lights.size()];
  // What is flat does not light itself.
  if (emitter.primitive == at.primitive && is_flat(emitter.form)) return std::nullopt;
  const EmitterSample place = sample_emitter(emitter.form, p, pair(place_pair));
  const Vec3 l = glm::normalize(place.position - p);
  Ray ray = rays_.spawn_ray(at.surface, l);
  ray.d = glm::normalize(place.position - ray.o);
  const double density = share * emitter_density(emitter.form, p, place);
  return Arriving{l,
                  ray,
                  glm::length(place.position - ray.o) * (1 - 1e-9),
                  emitter_radiance(scene_, emitter, place, p) / density,
                  density,
                  light};
}

// What that brings to the viewer by a vertex that sends on `scattered`; all but panes keeps the ray in
// `media`.
Vec3 PathSample::direct(const Interaction& at, const Arriving& light, const BsdfValue& scattered,
                        const MediaStack& media) {
  const double weight = light.density > 0 ? power_heuristic(light.density, scattered.density) : 1;
  const Vec3 contribution =
      light.radiance * transmittance(rays_.medium(media), light.distance) * scattered.value * weight;
  if (contribution == Vec3(0)) return Vec3(0);
  const bool beyond = glm::dot(light.ray.d, at.surface.normal_geometric) < 0;
  const MediaStack& passed = beyond && !at.in_medium() ? at.media_beyond : media;
  const Vec3 seen = any_pane_ ? rays_.through_panes(light.ray, light.distance, passed)
                              : Vec3(rays_.shadow(light.ray, light.distance));
  observer_.ray(RayKind::shadow, light.ray, depth_, 0);
  observer_.value("contribution", contribution);
  observer_.value("visibility", seen.x);
  observer_.back(depth_);
  asked_ = 2 * (light.light + 2) + (largest(seen) > 0 ? 1 : 0);
  return seen * contribution;
}

Vec3 PathSample::direct_on(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                           const MediaStack& media) {
  if (bsdf.black() || depth_ > scene_.render.max_depth) return Vec3(0);
  const auto light = arriving(at);
  if (!light || light->radiance == Vec3(0)) return Vec3(0);
  const Vec3 i = frame.into(light->l);
  const BsdfValue scattered = bsdf.at(i);
  if (scattered.value == Vec3(0)) return Vec3(0);
  if (!rays_.on_side(at.surface, light->l, light->distance, i.z > 0)) return Vec3(0);
  return direct(at, *light, scattered, i.z > 0 ? media : at.media_beyond);
}

Vec3 PathSample::direct_in(const Interaction& at, const MediaStack& media) {
  if (depth_ > scene_.render.max_depth) return Vec3(0);
  const auto light = arriving(at);
  if (!light || light->radiance == Vec3(0)) return Vec3(0);
  const double phase = phase_value(rays_.medium(media).anisotropy, glm::dot(at.d, light->l));
  return direct(at, *light, {Vec3(phase), phase}, media);
}

std::optional<Ray> PathSample::scatter(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                                       MediaStack& media) {
  if (bsdf.black()) return std::nullopt;
  const Vec2 chance = pair(scatter_pair);  // of a lobe, and of going on
  const BsdfSample sample = bsdf.sample(chance.x, pair(direction_pair));
  const bool passes = sample.kind == BsdfSample::Kind::passed;
  const bool straight = passes && panes_ < most_panes;  // this is no vertex
  Vec3 d;
  RayKind kind = RayKind::reflected;
  if (!straight) density_ = 0;
  if (passes) {
    d = at.d;
    kind = RayKind::refracted;
    throughput_ *= sample.weight;
  } else if (sample.kind == BsdfSample::Kind::lobe) {
    const BsdfValue value = bsdf.at(sample.i);
    d = frame.out_of(sample.i);
    const bool before = glm::dot(at.surface.normal_geometric, d) > 0;
    if (!(value.density > 0) || before != (sample.i.z > 0)) return std::nullopt;
    density_ = value.density;
    chosen_at_ = lit_point(at);
    throughput_ *= value.value / value.density;
    if (!before) kind = RayKind::refracted;
  } else {
    throughput_ *= sample.weight;
    if (sample.kind == BsdfSample::Kind::refracted) kind = RayKind::refracted;
    d = kind == RayKind::refracted ? at.refracted() : at.mirrored();
  }
  if (kind == RayKind::refracted && !passes) media = at.media_beyond;

  return continued(kind, at, d, chance.y, sample.lobe + 1 + (kind == RayKind::refracted ? through : 0),
                   straight);
}

std::optional<Ray> PathSample::scatter_in(const Medium& medium, const Interaction& at) {
  const Vec3 d = phase_direction(medium.anisotropy, at.d, pair(direction_pair));
  density_ = phase_value(medium.anisotropy, glm::dot(at.d, d));
  chosen_at_ = lit_point(at);
  return continued(RayKind::reflected, at, d, pair(scatter_pair).y, way_in_medium + 1);
}

// Roulette.
std::optional<Ray> PathSample::continued(RayKind kind, const Interaction& at, const Vec3& d, double chance,
                                         uint32_t way, bool straight) {
  const double survival = depth_ < first_roulette ? 1 : std::clamp(largest(throughput_), least_survival, 1.0);
  observer_.value("survival", survival);
  if (roulette_ && !(chance < survival)) return std::nullopt;
  rays_.cut_off = !straight && depth_ > scene_.render.max_depth;
  if (rays_.cut_off) return std::nullopt;
  throughput_ /= survival;
  // Before the next ray, since it belongs to this one.
  rays_.decided(Event::way, way);
  if (straight) {
    ++panes_;
    ++all_panes_;
  } else {
    panes_ = 0;
    ++depth_;
  }
  ++(kind == RayKind::reflected ? rays_.reflected : rays_.refracted);
  const Ray next = rays_.spawn_ray(at.surface, d);
  if (!straight) vertex_ = next.o;
  observer_.ray(kind, next, depth_);
  return next;
}

// A point of a medium, in the place of a surface.
Interaction PathSample::scattered_at(const Ray& ray, double t) const {
  Interaction at{.surface = {}, .d = ray.d, .cos_view = 1, .primitive = ~uint64_t{0}};
  at.surface.position = ray.o + t * ray.d;
  at.surface.normal = at.surface.normal_geometric = -ray.d;
  observer_.value("primitive", -1);
  observer_.value("t", t);
  observer_.value("position", at.surface.position);
  observer_.value("throughput", throughput_);
  return at;
}

PixelSample PathSample::sample(Ray ray, MediaStack media) {
  Vec3 color(0);
  vertex_ = ray.o;
  for (;;) {
    asked_ = 0;
    const auto hit = rays_.trace(ray);
    const Flight flight = fly(media, hit);
    const Vec3 before = throughput_;
    throughput_ *= flight.weight;
    std::optional<Ray> next;
    if (flight.scattered) {
      rays_.decided(Event::hit, in_medium);
      const Medium medium = rays_.medium(media);
      const Interaction at = scattered_at(ray, flight.t);
      const Vec3 light = direct_in(at, media);
      observer_.value("light", light);
      rays_.decided(Event::light, asked_);
      color += throughput_ * light;
      next = scatter_in(medium, at);
      if (!next) rays_.decided(Event::way, 0);
    } else if (hit) {
      const Interaction at = rays_.interaction(ray, *hit, media, before, flight.weight);
      rays_.decided(Event::hit, at.primitive + 1);
      const LocalFrame frame(at);
      const ViewedBsdf bsdf(at.bsdf, frame.viewer);
      const Vec3 light = emitted(at) + direct_on(at, frame, bsdf, media);
      observer_.value("light", light);
      rays_.decided(Event::light, asked_);
      color += throughput_ * light;
      if (at.has_medium && at.scattering.transmitted == Vec3(0) && depth_ <= scene_.render.max_depth)
        ++rays_.total_reflections;
      next = scatter(at, frame, bsdf, media);
      if (!next) rays_.decided(Event::way, 0);
    } else {
      rays_.decided(Event::hit, 0);
      const Vec3 light = missed(ray.d);
      observer_.miss(throughput_, light);
      color += throughput_ * light;
    }
    if (!next) break;
    ray = *next;
  }
  return rays_.sample(color);
}

AuxiliarySample PathSample::auxiliary(Ray ray, MediaStack media) {
  roulette_ = false;
  for (;;) {
    const auto hit = rays_.trace(ray);
    const Flight flight = fly(media, hit);
    const Vec3 before = throughput_;
    throughput_ *= flight.weight;
    if (flight.scattered) {
      const Medium medium = rays_.medium(media);
      Vec3 albedo(0);
      for (int c = 0; c < 3; ++c)
        if (medium.scattering[c] > 0)
          albedo[c] = medium.scattering[c] / (medium.scattering[c] + medium.absorption[c]);
      return {albedo, -ray.d};
    }
    if (!hit) return {Vec3(1), Vec3(0)};
    const Interaction at = rays_.interaction(ray, *hit, media, before, flight.weight);
    const LocalFrame frame(at);
    const ViewedBsdf bsdf(at.bsdf, frame.viewer);
    const bool shines = at.scattering.emitted != Vec3(0);
    const AuxiliarySample found{shines ? Vec3(1) : bsdf.albedo(), at.surface.normal};
    const auto next = bsdf.specular() ? scatter(at, frame, bsdf, media) : std::nullopt;
    if (!next) return found;
    ray = *next;
  }
}

PixelSample path(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                 const RayOffset& ray_offset, const Observer& observer) {
  return PathSample(tracer, id, ray_offset, observer).sample(ray, media);
}

}  // namespace

AuxiliarySample path_auxiliary(const Tracer& tracer, const SampleId& id, const Ray& ray,
                               const MediaStack& media) {
  return PathSample(tracer, id, {}, {}).auxiliary(ray, media);
}

extern const Integrator path_integrator{.manual = manual, .sample = path};

}  // namespace eyeray::reference
