#pragma once

#include <cstdint>

#include "host/core/vec.hpp"

namespace eyeray::reference {

// O'Neill's permutation of 32-bit integers, as Jarzynski and Olano recommend it for counters (Hash Functions
// for GPU Rendering, JCGT 9(3), 2020).
uint32_t pcg(uint32_t x);
// The upper 24 bits, as a number in [0, 1).
double fraction(uint32_t bits);

// A number in [0, 1), a multiple of 2⁻²⁴, that depends on nothing but the four.
double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed);
// The same of dimensions 2 · pair and 2 · pair + 1.
Vec2 random_pair(uint32_t pixel, uint32_t sample, uint32_t pair, uint32_t seed);

}  // namespace eyeray::reference
