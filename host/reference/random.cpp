#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::engine::reference {

extern const Sampler random_sampler{
    .manual =
        "All random numbers are independent of each other, selected by `seed` of [render](#render). Any "
        "number of samples is possible. This is for statistics.",
    .position = [](int, uint32_t pixel, uint32_t index,
                   uint32_t seed) { return random_pair(pixel, index, 0, seed); },
    .pair = random_pair};

}  // namespace eyeray::engine::reference
