// The probability of choosing each light of a scene, for integrators that cast one shadow ray at each vertex
// of a path.
#pragma once

#include "host/scene/emitters.hpp"
#include "host/scene/light_bvh.hpp"

namespace eyeray::engine {

// Lights are numbered consecutively: Scene::lights, then `emitters`.
struct LightChoice {
  std::vector<Emitter> emitters;  // in the order of their primitives
  // A choice draws one of 2²⁴ numbers. Light i is chosen by the numbers from the end of light i − 1 to below
  // ends[i]. Each light has at least one number, except the lights in `bvh`, which have none. The remaining
  // numbers choose the BVH.
  std::vector<uint32_t> ends;
  LightBvh bvh = {};

  // The probability of choosing light i, if it is not in `bvh`.
  double share(size_t i) const { return (ends[i] - (i == 0 ? 0 : ends[i - 1])) * 0x1p-24; }
  // The number of the 2²⁴ numbers that choose the BVH.
  uint32_t bvh_numbers() const;
};

// The choice that the scene's `light_sampler` sets: uniform, or by power with a sixteenth of it uniform, or
// by the BVH for lights that have a position and by power for all others. Error (bad_input) where more than
// 2²⁰ surfaces emit.
LightChoice light_choice(const Scene& scene);

}  // namespace eyeray::engine
