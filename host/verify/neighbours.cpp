#include "host/verify/neighbours.hpp"

#include <bit>

#include "host/reference/trail.hpp"
#include "host/scene/integrator.hpp"
#include "host/verify/photon_judge.hpp"

namespace eyeray::verify {
namespace {

uint64_t mix(uint64_t hash, uint64_t value) {
  return (hash ^ value) * 0x9e3779b97f4a7c15u + std::rotl(hash, 23);
}

// Adds to a neighbour's fingerprints what one sample's eye ray hits.
void add_first_hit(compare::Neighbour& neighbour, const Scene& scene, const FirstHit& hit) {
  neighbour.first_surfaces = mix(neighbour.first_surfaces, uint64_t(hit.primitive));
  if (hit.primitive < 0) return;
  const Vec3 color = scene.materials[size_t(hit.material)]->base_color({hit.uv, hit.position});
  for (int c = 0; c < 3; ++c)
    neighbour.first_colors = mix(neighbour.first_colors, std::bit_cast<uint64_t>(color[c]));
}

compare::Neighbour::Sample of(const PixelSample& sample) {
  return {sample.color, {double(sample.hits), double(sample.rays)}};
}

uint32_t seed_of(const Vec2& shift) {
  return uint32_t(mix(std::bit_cast<uint64_t>(shift.x), std::bit_cast<uint64_t>(shift.y)) >> 32);
}

// `count` samples of pixel (x, y) from `first` on, every ray moved by `shift`.
compare::Neighbour neighbour(const Scene& scene, const reference::Renderer& renderer, int x, int y,
                             const Vec2& shift, compare::Chance chance, int first, int count) {
  compare::Neighbour result;
  result.samples.clear();
  const uint32_t seed = seed_of(shift);
  const bool coincident = chance == compare::Chance::coincident;
  const double pivot = chance == compare::Chance::turned ? renderer.pivot(x, y, seed) : 0;
  for (int i = first; i < first + count; ++i) {
    const auto rendered = [&](reference::RayOffset ray_offset) {
      ray_offset.coincident = coincident;
      ray_offset.pivot = pivot;
      return renderer.sample(x, y, uint32_t(i), shift, ray_offset);
    };
    // From the farther surface rays would strike the nearer one, did they start as the mathematics says.
    const PixelSample sample =
        coincident ? rendered({reference::float32_ray_offset, true, seed}) : rendered({});
    result.samples.push_back(of(sample));
    using reference::TextureChoice;
    const auto add_rounded = [&](bool along_normal, TextureChoice textures) {
      result.rounded.push_back(of(rendered({reference::float32_ray_offset, along_normal, seed, textures})));
    };
    for (const bool along_normal : {false, true}) add_rounded(along_normal, TextureChoice::at_hit);
    result.rounded.push_back(of(
        rendered({.share = reference::float32_ray_offset, .seed = seed, .room = reference::float32_room})));
    if (walks_at_random(scene.render.integrator)) {
      // Weights ask how far off a ray starts, where a lamp or the surface's own curve is as near as that: so
      // twice as far, and eight times, as a bilinear patch has it (docs/numerics.md). Long paths bring other
      // light for less than that: so an eighth as well. And directions are rounded as numbers are
      // that they are drawn by.
      for (const double times : {8.0, 2.0, 0.125})
        result.rounded.push_back(of(rendered({times * reference::float32_ray_offset, false, seed})));
      result.rounded.push_back(
          of(rendered({.share = reference::float32_ray_offset, .seed = seed, .numbers = seed | 1})));
    }
    if (sends_photons(scene.render.integrator))
      for (const double nearer : {photon_aside, -photon_aside})
        result.rounded.push_back(of(rendered({.photon_nearer = nearer})));
    if (shift == Vec2(0.0))
      for (const auto textures : {TextureChoice::darkest, TextureChoice::brightest})
        add_rounded(false, textures);
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
  return [&](int x, int y, const Vec2& shift, compare::Chance chance) {
    return neighbour(scene, renderer, x, y, shift, chance, 0, scene.image.samples);
  };
}

compare::PathReference path_neighbours(const Scene& scene, const reference::Renderer& renderer,
                                       const executors::Twin* twin) {
  compare::PathReference paths;
  paths.around = [&](int sample) -> compare::Reference {
    return [&scene, &renderer, sample](int x, int y, const Vec2& shift, compare::Chance chance) {
      return neighbour(scene, renderer, x, y, shift, chance, sample, 1);
    };
  };
  paths.shaders = [twin](compare::Pixel pixel, int sample, uint32_t trail) {
    std::vector<uint32_t> events;
    if (twin) events = twin->events(pixel.x, pixel.y, uint32_t(sample));
    if (reference::trail_of(events) != trail) events.clear();
    return events;
  };
  paths.variants = 11;
  if (sends_photons(scene.render.integrator)) paths.shared = photon_radius(photon_settings(scene), 0);
  paths.reference = [&](compare::Pixel pixel, int sample, const Vec2& shift, int variant) {
    const uint32_t seed = seed_of(shift) | 1;
    constexpr double share = reference::float32_ray_offset;
    const reference::RayOffset ways[] = {
        {},
        {.share = share, .seed = seed},
        {.share = share, .along_normal = true, .seed = seed},
        {.seed = seed, .numbers = seed},
        {.share = share, .seed = seed, .numbers = seed},
        {.share = share, .along_normal = true, .seed = seed, .coincident = true},
        {.share = 2 * share, .seed = seed},
        {.share = 8 * share, .seed = seed},
        {.share = share, .seed = seed, .room = reference::float32_room},
        {.share = share / 8, .seed = seed, .room = reference::float32_room},
        {.pivot = variant == 10 ? renderer.pivot(pixel.x, pixel.y, seed) : 0},
    };
    std::vector<uint32_t> events;
    renderer.sample(pixel.x, pixel.y, uint32_t(sample), shift, ways[variant], reference::Observer(events));
    return events;
  };
  paths.rounding = [&](compare::Pixel pixel) {
    return renderer.rounding(pixel.x, pixel.y, renderer.first_hit(pixel.x, pixel.y).t);
  };
  paths.describe = reference::describe_event;
  return paths;
}

}  // namespace eyeray::verify
