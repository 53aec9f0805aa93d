// Kajiya: The Rendering Equation, SIGGRAPH 1986. Veach, Guibas: Optimally Combining Sampling Techniques for
// Monte Carlo Rendering, SIGGRAPH 1995. Arvo, Kirk: Particle Transport and Image Synthesis, SIGGRAPH 1990.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/reference/emitter_sample.hpp"
#include "host/reference/path_sample.hpp"
#include "host/reference/phase.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::reference {

extern const Integrator path_integrator;

namespace {

constexpr std::string_view manual =
    "Path tracing computes all light that surfaces scatter, reflect and refract onto each other, with one "
    "random path per sample. Surfaces that emit are lights, and `background` is light from all directions. "
    "Keys that approximate such light for `whitted` have no effect here: `ambient`, highlights (`specular`), "
    "`shadow` and `min_throughput`. Values of `diffuse` above 1 are cut to 1. `max_depth` is the number of "
    "surfaces lit after the first.";

constexpr int first_roulette = 3;
constexpr double least_survival = 0.05;

double largest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

// One colour channel, chosen in proportion to its remaining light, decides how far the path flies. The
// density is the mean of all three channels' densities, weighted by the same proportions.
Flight PathSample::fly(const Ray& ray, const MediaStack& media, const std::optional<Hit>& hit) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Medium medium = rays_.medium(media);
  const double end = hit ? hit->at.t : infinity;
  const double length = rays_.medium_length(media, ray, end);
  if (medium.scattering == Vec3(0)) {
    const bool open = !hit && media.top() >= 0;
    return {end, false, open ? Vec3(1) : transmittance(medium, length)};
  }
  const Vec3 extinction = medium.absorption + medium.scattering;
  const Vec2 random = pair_of(first_flight_pair + surfaces());
  // A path of throughput 0 continues until roulette ends it. Its flights are decided by the last channel, as
  // in the shaders.
  const double all = throughput_.x + throughput_.y + throughput_.z;
  const Vec3 shares = all > 0 ? throughput_ / all : Vec3(0, 0, 1);
  const int channel = random.x < shares.x ? 0 : random.x < shares.x + shares.y ? 1 : 2;
  const double drawn = extinction[channel] > 0 ? -std::log1p(-random.y) / extinction[channel] : infinity;
  if (drawn < length) {
    const Vec3 left = transmittance(medium, drawn);
    return {rays_.medium_distance(media, ray, drawn), true,
            medium.scattering * left / glm::dot(shares, extinction * left)};
  }
  const Vec3 left = transmittance(medium, length);
  return {end, false, left / glm::dot(shares, left)};
}

// A path that hits the boundary of a medium with dispersion goes on with the light of one channel, chosen in
// proportion to the light left in each.
Vec3 PathSample::dispersed(const std::optional<Hit>& hit, const Flight& flight,
                           const MediaStack& media) const {
  if (!hit || flight.scattered) return Vec3(1);
  const Material& material = *scene_.materials[size_t(hit->material)];
  if (!fills(material, scene_.render.integrator)) return Vec3(1);
  MediaStack below = media;
  if (media.top() >= 0) below.remove(media.top());
  const bool disperses = material.medium()->dispersion > 0 || rays_.medium(media).dispersion > 0 ||
                         rays_.medium(below).dispersion > 0;
  const Vec3 light = throughput_ * flight.weight;
  const double all = light.x + light.y + light.z;
  if (!disperses || all == 0) return Vec3(1);
  const double random = pair_of(channel_pair).x * all;
  const int channel = random < light.x ? 0 : random < light.x + light.y ? 1 : 2;
  if (light[channel] == 0) return Vec3(1);  // light that rounding alone has left
  Vec3 factor(0);
  factor[channel] = all / light[channel];
  return factor;
}

std::optional<Ray> PathSample::scatter(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                                       MediaStack& media) {
  if (bsdf.black()) return std::nullopt;
  const Vec2 random = pair(scatter_pair);  // random numbers that choose the lobe, and that roulette uses
  const BsdfSample sample = bsdf.sample(random.x, pair(direction_pair));
  const bool passes = sample.kind == BsdfSample::Kind::passed;
  const bool straight = passes && panes_ < most_panes;  // a crossing that is no vertex of the path
  Vec3 d;
  RayKind kind = RayKind::reflected;
  if (!straight) density_ = 0;
  if (passes) {
    d = at.d;
    kind = RayKind::refracted;
    throughput_ *= sample.weight;
  } else if (sample.kind == BsdfSample::Kind::lobe) {
    d = frame.out_of(sample.i);
    const bool before = leaving(at, d) == Leaving::in_front;
    const BsdfValue value = bsdf.at(sample.i, before);
    if (!(value.density > 0) || !bsdf.faces(sample.i, before)) return std::nullopt;
    density_ = value.density;
    chosen_at_ = lit_point(at);
    throughput_ *= value.value / value.density;
    if (!before) kind = RayKind::refracted;
  } else {
    if (sample.kind == BsdfSample::Kind::refracted) kind = RayKind::refracted;
    d = kind == RayKind::refracted ? at.refracted() : at.mirrored();
    throughput_ *= sample.weight * bsdf.through_layers(frame.into(d));
  }
  if (kind == RayKind::refracted) media = at.media_beyond;

  // A ray that is refracted, or passes straight through, leaves the surface along its own line.
  const bool bent = passes || sample.kind == BsdfSample::Kind::refracted;
  const Leaving side = bent                         ? Leaving::straight
                       : kind == RayKind::reflected ? Leaving::in_front
                                                    : Leaving::behind;
  return continued(kind, at, d, side, random.y, sample.lobe + 1 + (kind == RayKind::refracted ? through : 0),
                   straight);
}

std::optional<Ray> PathSample::scatter_in(const Medium& medium, const Interaction& at) {
  const Vec3 d = phase_direction(medium.anisotropy, at.d, pair(direction_pair));
  density_ = phase_value(medium.anisotropy, glm::dot(at.d, d));
  chosen_at_ = lit_point(at);
  return continued(RayKind::reflected, at, d, Leaving::straight, pair(scatter_pair).y, way_in_medium + 1);
}

// Continues a path by Russian roulette: returns the next ray, or none.
std::optional<Ray> PathSample::continued(RayKind kind, const Interaction& at, const Vec3& d, Leaving side,
                                         double random, uint32_t way, bool straight) {
  const double survival = depth_ < first_roulette ? 1 : std::clamp(largest(throughput_), least_survival, 1.0);
  observer_.value("survival", survival);
  if (roulette_ && !(random < survival)) return std::nullopt;
  rays_.cut_off = !straight && depth_ > scene_.render.max_depth;
  if (rays_.cut_off) return std::nullopt;
  throughput_ /= survival;
  // Record the decision before the next ray, since it belongs to this one.
  rays_.decided(Event::way, way);
  if (straight) {
    ++panes_;
    ++all_panes_;
  } else {
    panes_ = 0;
    ++depth_;
  }
  ++(kind == RayKind::reflected ? rays_.reflected : rays_.refracted);
  const Ray next = rays_.spawn_ray(at.surface, d, side);
  if (!straight) vertex_ = next.o;
  observer_.ray(kind, next, depth_);
  return next;
}

// The interaction at a point of a medium, which stands in for a surface.
Interaction PathSample::scattered_at(const Ray& ray, double t) const {
  Interaction at{.surface = {}, .d = ray.d, .cos_view = 1, .primitive = ~uint64_t{0}};
  at.surface.position = ray.o + t * ray.d;
  at.surface.normal = at.surface.normal_geometric = at.surface.normal_side = -ray.d;
  observer_.value("primitive", -1);
  observer_.value("t", t);
  observer_.value("position", at.surface.position);
  observer_.value("throughput", throughput_);
  return at;
}

std::optional<Ray> PathSample::hit_medium(const Ray& ray, const Flight& flight, const MediaStack& media,
                                          Vec3& color) {
  rays_.decided(Event::hit, in_medium);
  const Interaction at = scattered_at(ray, flight.t);
  gain(direct_in(at, media), color);
  return scatter_in(rays_.medium(media), at);
}

std::optional<Ray> PathSample::hit_surface(const Interaction& at, const LocalFrame& frame,
                                           const ViewedBsdf& bsdf, MediaStack& media, Vec3& color) {
  gain(emitted(at) + direct_on(at, frame, bsdf, media), color);
  return scatter(at, frame, bsdf, media);
}

void PathSample::gain(const Vec3& light, Vec3& color) {
  observer_.value("light", light);
  rays_.decided(Event::light, light_event_);
  color += throughput_ * light;
}

PixelSample PathSample::follow(Ray ray, MediaStack media, Meet meet) {
  Vec3 color(0);
  vertex_ = ray.o;
  for (;;) {
    light_event_ = 0;
    ray = with_key(ray, 0);
    const auto hit = rays_.trace(ray);
    const Flight flight = fly(ray, media, hit);
    const Vec3 before = throughput_;
    const Vec3 weight = flight.weight * dispersed(hit, flight, media);
    throughput_ *= weight;
    std::optional<Ray> next;
    if (flight.scattered) {
      next = hit_medium(ray, flight, media, color);
    } else if (hit) {
      const Interaction at = rays_.interaction(ray, *hit, media, before, weight);
      rays_.decided(Event::hit, at.primitive + 1);
      const LocalFrame frame = LocalFrame::of(at.surface);
      if (at.has_medium && at.scattering.transmitted == Vec3(0) && depth_ <= scene_.render.max_depth)
        ++rays_.total_reflections;
      next = (this->*meet)(at, frame, ViewedBsdf(at.bsdf, frame.seen(-at.d)), media, color);
    } else {
      rays_.decided(Event::hit, 0);
      const bool straight =
          scene_.image.transparent && depth_ == 0;  // the background of a transparent picture
      if (straight) rays_.background = luminance(throughput_);
      const Vec3 light = straight ? Vec3(0) : missed(ray.d);
      observer_.miss(throughput_, light);
      color += throughput_ * light;
      break;
    }
    if (!next) {
      rays_.decided(Event::way, 0);
      break;
    }
    ray = *next;
  }
  return rays_.sample(color);
}

AuxiliarySample PathSample::auxiliary(Ray ray, MediaStack media) {
  roulette_ = false;
  for (;;) {
    ray = with_key(ray, 0);
    const auto hit = rays_.trace(ray);
    const Flight flight = fly(ray, media, hit);
    const Vec3 before = throughput_;
    const Vec3 weight = flight.weight * dispersed(hit, flight, media);
    throughput_ *= weight;
    if (flight.scattered) {
      const Medium medium = rays_.medium(media);
      Vec3 albedo(0);
      for (int c = 0; c < 3; ++c)
        if (medium.scattering[c] > 0)
          albedo[c] = medium.scattering[c] / (medium.scattering[c] + medium.absorption[c]);
      return {albedo, -ray.d};
    }
    if (!hit) return {Vec3(1), Vec3(0)};
    const Interaction at = rays_.interaction(ray, *hit, media, before, weight);
    const LocalFrame frame = LocalFrame::of(at.surface);
    const ViewedBsdf bsdf(at.bsdf, frame.seen(-at.d));
    const bool shines = at.scattering.emitted != Vec3(0);
    const AuxiliarySample found{shines ? Vec3(1) : bsdf.albedo(), at.surface.normal};
    const auto next = bsdf.specular() ? scatter(at, frame, bsdf, media) : std::nullopt;
    if (!next) return found;
    ray = *next;
  }
}

namespace {

PixelSample path(const Tracer& tracer, const SampleId& id, const Ray& ray, const MediaStack& media,
                 const rounding::Displacement& displacement, const Observer& observer) {
  return PathSample(tracer, id, displacement, observer).sample(ray, media);
}

}  // namespace

AuxiliarySample path_auxiliary(const Tracer& tracer, const SampleId& id, const Ray& ray,
                               const MediaStack& media) {
  return PathSample(tracer, id, {}, {}).auxiliary(ray, media);
}

extern const Integrator path_integrator{.manual = manual, .sample = path};

}  // namespace eyeray::engine::reference
