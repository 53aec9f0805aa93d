#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::reference {

extern const Sampler jittered_sampler{
    .manual = "Each sample lies at a random place of its cell, by `seed` of [render](#render).",
    .in_cell = [](uint32_t pixel, uint32_t index, uint32_t seed) {
      return Vec2(random(pixel, index, 0, seed), random(pixel, index, 1, seed));
    }};

}  // namespace eyeray::reference
