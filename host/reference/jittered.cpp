#include "host/reference/grid.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::engine::reference {

extern const Sampler jittered_sampler{
    .manual =
        "Each sample lies at a random point of its cell. `seed` of [render](#render) selects the random "
        "numbers.",
    .position = [](int samples, uint32_t pixel, uint32_t index,
                   uint32_t seed) { return in_grid(samples, index, random_pair(pixel, index, 0, seed)); },
    .pair = random_pair};

}  // namespace eyeray::engine::reference
