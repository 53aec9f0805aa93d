#include "host/verify/neighbours.hpp"

#include <bit>

#include "host/reference/trail.hpp"
#include "host/rounding/ways.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::verify {
namespace {

uint64_t mix(uint64_t hash, uint64_t value) {
  return (hash ^ value) * 0x9e3779b97f4a7c15u + std::rotl(hash, 23);
}

// Adds the hit of one sample's camera ray to a neighbour's fingerprints.
void add_first_hit(compare::Neighbour& neighbour, const Scene& scene, const FirstHit& hit) {
  neighbour.first_surfaces = mix(neighbour.first_surfaces, uint64_t(hit.primitive));
  if (hit.primitive < 0) return;
  const Vec3 color = scene.materials[size_t(hit.material)]->base_color({hit.uv, hit.position});
  for (int c = 0; c < 3; ++c)
    neighbour.first_colors = mix(neighbour.first_colors, std::bit_cast<uint64_t>(color[c]));
}

compare::Neighbour::Sample of(const PixelSample& sample) {
  return {sample.over_white(), {double(sample.hits), double(sample.rays)}};
}

uint32_t seed_of(const Vec2& shift) {
  return uint32_t(mix(std::bit_cast<uint64_t>(shift.x), std::bit_cast<uint64_t>(shift.y)) >> 32);
}

// `count` samples of pixel (x, y) from `first` on, every ray moved by `shift`.
compare::Neighbour neighbour(const Scene& scene, const reference::Renderer& renderer, int x, int y,
                             const Vec2& shift, rounding::Coincidence coincidence, int first, int count) {
  compare::Neighbour result;
  result.samples.clear();
  const uint32_t seed = seed_of(shift);
  const IntegratorType integrator = scene.render.integrator;
  const bool coincident = coincidence == rounding::Coincidence::coincident;
  const double pivot = coincidence == rounding::Coincidence::turned ? renderer.pivot(x, y, seed) : 0;
  const std::vector<rounding::Displacement> ways = rounding::ways_of_sample(
      {walks_at_random(integrator), sends_photons(integrator)}, coincidence, pivot, shift != Vec2(0.0), seed);
  for (int i = first; i < first + count; ++i) {
    const PixelSample sample = renderer.sample(x, y, uint32_t(i), shift, ways.front());
    result.samples.push_back(of(sample));
    for (size_t k = 1; k < ways.size(); ++k)
      result.rounded.push_back(of(renderer.sample(x, y, uint32_t(i), shift, ways[k])));
    result.direct = result.direct && sample.hits <= 1;
    add_first_hit(result, scene,
                  renderer.first_hit_of_sample(x, y, uint32_t(i), shift, {.coincident = coincident}));
  }
  result.first_hit = renderer.first_hit(x, y, shift, {.coincident = coincident, .pivot = pivot});
  result.rounding = renderer.rounding(x, y, result.first_hit.t);
  return result;
}

}  // namespace

compare::Reference neighbours(const Scene& scene, const reference::Renderer& renderer) {
  return [&](int x, int y, const Vec2& shift, rounding::Coincidence coincidence) {
    return neighbour(scene, renderer, x, y, shift, coincidence, 0, scene.image.samples);
  };
}

compare::PathReference path_neighbours(const Scene& scene, const reference::Renderer& renderer,
                                       const executors::Twin* twin) {
  compare::PathReference paths;
  paths.around = [&](int sample) -> compare::Reference {
    return [&scene, &renderer, sample](int x, int y, const Vec2& shift, rounding::Coincidence coincidence) {
      return neighbour(scene, renderer, x, y, shift, coincidence, sample, 1);
    };
  };
  paths.shaders = [twin](compare::Pixel pixel, int sample, uint32_t trail) {
    std::vector<uint32_t> events;
    if (twin) events = twin->events(pixel.x, pixel.y, uint32_t(sample));
    if (reference::trail_of(events) != trail) events.clear();
    return events;
  };
  paths.variants = rounding::path_ways;
  if (sends_photons(scene.render.integrator)) paths.shared = photon_radius(photon_settings(scene), 0);
  paths.reference = [&](compare::Pixel pixel, int sample, const Vec2& shift, int variant) {
    const uint32_t seed = seed_of(shift) | 1;
    const double pivot = variant + 1 == rounding::path_ways ? renderer.pivot(pixel.x, pixel.y, seed) : 0;
    const rounding::Displacement way = rounding::ways_of_path(pivot, seed)[size_t(variant)];
    std::vector<uint32_t> events;
    renderer.sample(pixel.x, pixel.y, uint32_t(sample), shift, way, reference::Observer(events));
    return events;
  };
  paths.rounding = [&](compare::Pixel pixel) {
    return renderer.rounding(pixel.x, pixel.y, renderer.first_hit(pixel.x, pixel.y).t);
  };
  paths.describe = reference::describe_event;
  return paths;
}

}  // namespace eyeray::engine::verify
