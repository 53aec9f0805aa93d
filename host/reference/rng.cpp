#include "host/reference/rng.hpp"

namespace eyeray::reference {

static uint32_t pcg(uint32_t x) {
  const uint32_t state = x * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed) {
  const uint32_t bits = pcg(pixel + pcg(sample + pcg(dimension + pcg(seed))));
  return (bits >> 8) * 0x1p-24;
}

}  // namespace eyeray::reference
