// The lists of displacements that the reference is asked for: a value that one of them leads to is explained.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/rounding/displacement.hpp"

namespace eyeray::engine::rounding {

// What float32 may make of an eye ray that is moved, beside moving it.
enum class Chance {
  none,
  coincident,  // of two surfaces that float32 cannot tell apart, it hits the farther one
  turned,  // before its hit an eye ray lies on the side that it is moved to, and behind its hit on the other
};

// How a picture is made.
struct Sampling {
  bool random_paths = false;
  bool photons = false;
};

// The ways of a sample whose eye ray `chance` displaces. The first rounds no other ray.
// `pivot`: of a ray that is turned. `moved`: the ray passes another place than the sample's own.
std::vector<Displacement> ways_of_sample(const Sampling& sampling, Chance chance, double pivot, bool moved,
                                         uint32_t seed);

// The ways of a random path that may diverge from another. The last one turns the eye's ray.
inline constexpr int path_ways = 11;
std::array<Displacement, path_ways> ways_of_path(double pivot, uint32_t seed);

// The ways of a photon: those of float32, times one of `photon_scales`. Surfaces that are round, or struck at
// a grazing angle, multiply what float32 rounds, one after the other. The widest is 10⁻⁴ of the distance to
// the eye: the distance of gate B's places in a picture 100 pixels wide.
inline constexpr double photon_scales[] = {1, 8, 64};
std::array<Displacement, 6> ways_of_photon(double scale, uint32_t seed);

// The ways of a probed sample: few, since each is shown ray by ray.
std::vector<Displacement> ways_of_probe(bool moved, uint32_t seed);

}  // namespace eyeray::engine::rounding
