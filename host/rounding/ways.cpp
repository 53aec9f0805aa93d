#include "host/rounding/ways.hpp"

namespace eyeray::engine::rounding {

std::vector<Displacement> ways_of_sample(const Sampling& sampling, Coincidence coincidence, double pivot,
                                         bool moved, uint32_t seed) {
  constexpr double share = float32_share;
  // Rays that left the farther surface without displacement would hit the nearer one.
  const Displacement plain = coincidence == Coincidence::coincident
                                 ? Displacement{.share = share, .along_normal = true, .seed = seed}
                                 : Displacement{};
  std::vector<Displacement> ways = {
      plain,
      {.share = share, .seed = seed},
      {.share = share, .along_normal = true, .seed = seed},
      {.share = share, .seed = seed, .room = float32_room},
  };
  if (sampling.random_paths) {
    // A ray starts a small distance from its surface. Where a light or the surface's own curve is as near as
    // that, weights depend on the distance: so try it twofold, and eightfold, as on a bilinear patch
    // (docs/numerics.md). Long paths carry other light for less: so try an eighth as well. Directions are
    // rounded like the random numbers that they are drawn by.
    for (const double times : {8.0, 2.0, 0.125}) ways.push_back({.share = times * share, .seed = seed});
    ways.push_back({.share = share, .seed = seed, .numbers = seed | 1});
  }
  if (sampling.photons)
    for (const int photon : {1, -1}) ways.push_back({.photon = photon});
  if (!moved)
    for (const TextureChoice textures : {TextureChoice::darkest, TextureChoice::brightest})
      ways.push_back({.share = share, .seed = seed, .textures = textures});
  for (Displacement& way : ways) {
    way.coincident = coincidence == Coincidence::coincident;
    way.pivot = pivot;
  }
  return ways;
}

std::array<Displacement, path_ways> ways_of_path(double pivot, uint32_t seed) {
  constexpr double share = float32_share;
  return {{
      {},
      {.share = share, .seed = seed},
      {.share = share, .along_normal = true, .seed = seed},
      {.seed = seed, .numbers = seed},
      {.share = share, .seed = seed, .numbers = seed},
      {.share = share, .along_normal = true, .seed = seed, .coincident = true},
      {.share = 2 * share, .seed = seed},
      {.share = 8 * share, .seed = seed},
      {.share = share, .seed = seed, .room = float32_room},
      {.share = share / 8, .seed = seed, .room = float32_room},
      {.pivot = pivot},
  }};
}

std::array<Displacement, 6> ways_of_photon(double scale, uint32_t seed) {
  const double share = scale * float32_share;
  return {{
      {.share = share, .seed = seed},
      {.share = share, .seed = seed, .numbers = seed},
      {.share = share, .along_normal = true, .seed = seed},
      {.share = share,
       .seed = seed,
       .off = 1.0 / 64},  // along a ring, where the surface's own offset is small
      {.share = share, .along_normal = true, .seed = seed, .coincident = true},
      {.share = share, .seed = seed, .coincident = true, .numbers = seed},
  }};
}

std::vector<Displacement> ways_of_probe(bool moved, uint32_t seed) {
  constexpr double share = float32_share;
  std::vector<Displacement> ways = {
      {}, {.share = share, .seed = seed}, {.share = share, .along_normal = true, .seed = seed}};
  if (moved) return ways;
  for (const TextureChoice textures : {TextureChoice::darkest, TextureChoice::brightest})
    ways.push_back({.share = share, .seed = seed, .textures = textures});
  ways.push_back({.share = share, .along_normal = true, .seed = seed, .coincident = true});
  return ways;
}

}  // namespace eyeray::engine::rounding
