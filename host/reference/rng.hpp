#pragma once

#include <cstdint>

namespace eyeray::reference {

// A number in [0, 1), a multiple of 2⁻²⁴, that depends on nothing but the four: counter-based, by PCG hashes
// (Jarzynski, Olano: Hash Functions for GPU Rendering, JCGT 9(3), 2020).
double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed);

}  // namespace eyeray::reference
