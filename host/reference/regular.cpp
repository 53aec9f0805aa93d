#include "host/reference/sampler.hpp"

namespace eyeray::reference {

extern const Sampler regular_sampler{.manual = "Samples lie at the centres of the grid's cells.",
                                     .in_cell = [](uint32_t, uint32_t, uint32_t) { return Vec2(0.5); }};

}  // namespace eyeray::reference
