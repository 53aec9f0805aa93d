// One random path, as a sample of a pixel follows it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/reference/bsdf.hpp"
#include "host/reference/emitter_sample.hpp"
#include "host/reference/integrator.hpp"
#include "host/reference/light_pick.hpp"
#include "host/reference/local_frame.hpp"
#include "host/reference/photon_map.hpp"
#include "host/reference/photon_source.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sample_rays.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::engine::reference {

// The numbers of the pairs of random numbers for each use, at the first vertex. From vertex to vertex they
// grow by `pairs_a_vertex`.
inline constexpr uint32_t scatter_pair = 4, direction_pair = 5, light_pair = 6, emitter_pair = 7,
                          pairs_a_vertex = 4;
inline constexpr uint32_t channel_pair = 0xffff;
inline constexpr uint32_t first_flight_pair =
    0x10000;  // at the first vertex; it grows by 1 from vertex to vertex

// The point at which lights are sampled.
LitPoint lit_point(const Interaction& at);
// The side of the surface on which a ray in direction d leaves.
Leaving leaving(const Interaction& at, const Vec3& d);
// The weight of a sampling technique of density p that is combined with one of density q.
double power_heuristic(double p, double q);

// Light that arrives from a light in direction l, if nothing blocks the ray before `distance`.
struct Arriving {
  Vec3 l;
  Ray ray;
  double distance;
  Vec3 radiance;   // divided by the density of the choice
  double density;  // by solid angle, with the choice of the light; 0 for a light without extent
  uint64_t light;  // its number; −1 for the environment
};

// The distance that a path travels through a medium: up to a point in it, or to the hit of the ray.
struct Flight {
  double t;
  bool scattered;
  Vec3 weight;  // weight of the light that comes from there
};

class PathSample {
 public:
  PathSample(const Tracer& tracer, const SampleId& id, const rounding::Displacement& displacement,
             const Observer& observer)
      : tracer_(tracer),
        scene_(tracer.scene()),
        id_(id),
        numbers_(displacement.numbers),
        photon_(displacement.photon),
        rays_(tracer, displacement, observer),
        observer_(observer) {}

  PixelSample sample(Ray ray, MediaStack media) { return follow(ray, media, &PathSample::hit_surface); }
  // Follows the path up to the point where photons are gathered, and adds their light.
  PixelSample gathering_sample(Ray ray, MediaStack media) {
    return follow(ray, media, &PathSample::hit_gathering);
  }
  // Traces one photon of a sample. Each time that a surface stores the photon, appends it to `stopped`. The
  // id's index is the photon's number; the id's pixel is photons_of | the sample's number. Returns the
  // photon's way.
  PhotonWay photon(const PhotonSources& sources, std::vector<Photon>& stopped);
  AuxiliarySample auxiliary(Ray ray, MediaStack media);

 private:
  Vec2 pair(uint32_t use) const { return pair_of(use + pairs_a_vertex * surfaces()); }
  Vec2 pair_of(uint32_t number) const {
    Vec2 pair = sampler(scene_.image.pattern).pair(id_.pixel, id_.index, number, scene_.render.seed);
    // Displace the numbers, to test float32's effect on those near to a decision.
    if (numbers_ != 0)
      for (uint32_t i = 0; i < 2; ++i)
        pair[int(i)] = std::clamp(pair[int(i)] + std::floor(9 * random(numbers_, number, i, 0) - 4) * 0x1p-24,
                                  0.0, 1 - 0x1p-24);
    return pair;
  }
  // The ray with the alpha key of ray `number` from the path's current vertex.
  Ray with_key(Ray ray, uint32_t number) const {
    ray.alpha_key = alpha_key(id_.pixel, id_.index, surfaces(), number, scene_.render.seed);
    return ray;
  }
  // The number of surfaces that the path has passed.
  uint32_t surfaces() const { return uint32_t(depth_ + all_panes_); }
  Flight fly(const Ray& ray, const MediaStack& media, const std::optional<Hit>& hit) const;
  // The factor of the path's light at its hit.
  Vec3 dispersed(const std::optional<Hit>& hit, const Flight& flight, const MediaStack& media) const;
  Interaction scattered_at(const Ray& ray, double t) const;
  // Adds the light at the path's hit to `color`, and continues from there: returns the next ray, or none.
  using Meet = std::optional<Ray> (PathSample::*)(const Interaction& at, const LocalFrame& frame,
                                                  const ViewedBsdf& bsdf, MediaStack& media, Vec3& color);
  std::optional<Ray> hit_surface(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                                 MediaStack& media, Vec3& color);
  std::optional<Ray> hit_gathering(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                                   MediaStack& media, Vec3& color);
  std::optional<Ray> hit_medium(const Ray& ray, const Flight& flight, const MediaStack& media, Vec3& color);
  // Adds the light of a vertex whose lights have been sampled.
  void gain(const Vec3& light, Vec3& color);
  // Follows the path to its end, and calls `meet` at every surface.
  PixelSample follow(Ray ray, MediaStack media, Meet meet);
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
  std::optional<Ray> continued(RayKind kind, const Interaction& at, const Vec3& d, Leaving side,
                               double random, uint32_t way, bool straight = false);
  std::optional<Ray> scatter(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& bsdf,
                             MediaStack& media);
  Vec3 direct_on_parts(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& wide,
                       const ViewedBsdf& sharp, const MediaStack& media);
  Vec3 gathered(const Interaction& at, const LocalFrame& frame, const ViewedBsdf& wide,
                const PhotonMap& photons) const;

  const Tracer& tracer_;
  const Scene& scene_;
  const SampleId id_;
  const uint32_t numbers_;
  const int photon_;
  SampleRays rays_;
  const Observer& observer_;
  const bool any_pane_ = tracer_.any_interface() || std::ranges::any_of(scene_.materials, &Material::thin);
  int depth_ = 0;
  int panes_ = 0, all_panes_ = 0;  // panes that the path passed straight, since its last vertex and in all
  Vec3 vertex_{0};                 // the path's last vertex, or the eye
  Vec3 throughput_{1};
  bool roulette_ = true;
  uint64_t light_event_ = 0;  // the value of Event::light of the last vertex
  double density_ = 0;  // density of the ray's direction, by solid angle; 0 if the direction was the only one
  LitPoint chosen_at_{};  // the point where the ray's direction was chosen
};

}  // namespace eyeray::engine::reference
