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
  turned,  // an eye ray is aside as far as it is moved before what it hits, and behind it on the other side
};

// How a picture is made.
struct Sampling {
  bool random_paths = false;
  bool photons = false;
};

// Of a sample, of which `chance` decides what its eye ray hits: first without rounding any other ray.
// `pivot`: of a ray that is turned. `moved`: the ray passes another place than the sample's own.
std::vector<Displacement> ways_of_sample(const Sampling& sampling, Chance chance, double pivot, bool moved,
                                         uint32_t seed);

// Of a random path that may part from another. The last is the one that turns the eye's ray.
inline constexpr int path_ways = 11;
std::array<Displacement, path_ways> ways_of_path(double pivot, uint32_t seed);

// Of a photon, each as float32 rounds times `photon_scales`. Surfaces that are round, or struck at a grazing
// angle, multiply what float32 rounds, one after the other. The widest is 10⁻⁴ of the distance to the eye: as
// far aside as the places are in a picture 100 pixels wide where gate B asks.
inline constexpr double photon_scales[] = {1, 8, 64};
std::array<Displacement, 6> ways_of_photon(double scale, uint32_t seed);

// Of a sample that is probed: fewer, since each is shown ray by ray.
std::vector<Displacement> ways_of_probe(bool moved, uint32_t seed);

}  // namespace eyeray::engine::rounding
