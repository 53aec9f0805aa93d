// The lists of displacements with which the reference is evaluated again. A value that one of them leads to
// is explained.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/rounding/displacement.hpp"

namespace eyeray::engine::rounding {

// Effects of float32 on a displaced camera ray, in addition to its displacement.
enum class Coincidence {
  none,
  coincident,  // the ray hits the farther of two surfaces that float32 cannot distinguish
  turned,      // the ray pivots at its hit: displaced to one side in front of it, to the other side behind it
};

// The parts of the picture's method that the ways depend on.
struct Sampling {
  bool random_paths = false;
  bool photons = false;
};

// The ways of a sample whose camera ray `coincidence` displaces. The first way displaces no other ray, unless
// `coincidence` is coincident. `pivot`: the t at which the ray pivots. `moved`: the ray passes through
// another position than the sample's own.
std::vector<Displacement> ways_of_sample(const Sampling& sampling, Coincidence coincidence, double pivot,
                                         bool moved, uint32_t seed);

// The ways of a random path that may diverge from another path. The last way pivots the camera ray.
inline constexpr int path_ways = 11;
std::array<Displacement, path_ways> ways_of_path(double pivot, uint32_t seed);

// The ways of a photon: float32's displacements times `scale`, one of `photon_scales`. Each surface that is
// curved, or hit at a grazing angle, multiplies the rounding again. The widest displacement is 10⁻⁴ of the
// distance to the eye. Gate B's positions are displaced as far in a picture 100 pixels wide.
inline constexpr double photon_scales[] = {1, 8, 64};
std::array<Displacement, 6> ways_of_photon(double scale, uint32_t seed);

// The ways of a probed sample: few, since each is shown ray by ray.
std::vector<Displacement> ways_of_probe(bool moved, uint32_t seed);

}  // namespace eyeray::engine::rounding
