// Smooth noise by integer hashes and polynomials alone, hence the same to the last bit on every machine.
#pragma once

#include <cstdint>

#include "host/core/vec.hpp"

namespace eyeray::engine::generate {

struct Noise {
  double value;
  Vec2 gradient;
};

// Value noise: random numbers of [−1, 1] at whole coordinates, joined by a quintic, so that curvature is
// continuous. After Quilez, "Value noise derivatives", 2008.
Noise noise(const Vec2& p, uint32_t seed);

}  // namespace eyeray::engine::generate
