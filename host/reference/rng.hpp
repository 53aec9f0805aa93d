#pragma once

#include <cstdint>

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

// O'Neill's permutation of 32-bit integers, as Jarzynski and Olano recommend it for counters (Hash Functions
// for GPU Rendering, JCGT 9(3), 2020).
uint32_t pcg(uint32_t x);
// The upper 24 bits, as a number in [0, 1).
double fraction(uint32_t bits);

// A number in [0, 1), a multiple of 2⁻²⁴, that depends on the four arguments only.
double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed);
// Two random numbers: those of dimensions 2 · pair and 2 · pair + 1.
Vec2 random_pair(uint32_t pixel, uint32_t sample, uint32_t pair, uint32_t seed);

// Ray::alpha_key of a ray that starts after a sample's path has passed `surfaces` surfaces. Number 0 is the
// path's own ray; number 1 + i is its i-th shadow ray.
uint32_t alpha_key(uint32_t pixel, uint32_t sample, uint32_t surfaces, uint32_t number, uint32_t seed);
// The least alpha of a blended surface at which a ray of that key hits the primitive, in (0, 1]: a hash, so
// that it does not depend on the order of a search.
double least_alpha(uint32_t key, uint64_t primitive);

}  // namespace eyeray::engine::reference
