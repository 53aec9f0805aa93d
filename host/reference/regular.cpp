#include "host/reference/grid.hpp"
#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::engine::reference {

extern const Sampler regular_sampler{
    .manual = "Each pixel is divided into n × n cells. The samples lie at the centres of the cells.",
    .position = [](int samples, uint32_t, uint32_t index,
                   uint32_t) { return in_grid(samples, index, Vec2(0.5)); },
    .pair = random_pair};

}  // namespace eyeray::engine::reference
