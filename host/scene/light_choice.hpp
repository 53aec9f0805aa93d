// How likely each light of a scene is chosen: for integrators that cast one shadow ray at each vertex of a
// path.
#pragma once

#include "host/scene/emitters.hpp"
#include "host/scene/light_bvh.hpp"

namespace eyeray::engine {

// Lights are counted on: Scene::lights, then `emitters`.
struct LightChoice {
  std::vector<Emitter> emitters;  // in the order of their primitives
  // Light i is chosen by the numbers below ends[i] of 2²⁴, and not below those before it. Each has one at
  // least, but for those in `bvh`, which have none; what is left of 2²⁴ chooses that.
  std::vector<uint32_t> ends;
  LightBvh bvh = {};

  // How likely light i is chosen, if it is not in `bvh`.
  double share(size_t i) const { return (ends[i] - (i == 0 ? 0 : ends[i - 1])) * 0x1p-24; }
  // By how many numbers the BVH is chosen.
  uint32_t bvh_numbers() const;
};

// As the scene's `light_sampler` says: evenly, or by power, a sixteenth of it evenly; by the BVH those that
// have a place, and all others by power. Error (bad_input) where more than 2²⁰ surfaces emit.
LightChoice light_choice(const Scene& scene);

}  // namespace eyeray::engine
