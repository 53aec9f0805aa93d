#include "host/reference/rng.hpp"

namespace eyeray::reference {

uint32_t pcg(uint32_t x) {
  const uint32_t state = x * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double fraction(uint32_t bits) {
  return (bits >> 8) * 0x1p-24;
}

double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed) {
  return fraction(pcg(pixel + pcg(sample + pcg(dimension + pcg(seed)))));
}

Vec2 random_pair(uint32_t pixel, uint32_t sample, uint32_t pair, uint32_t seed) {
  return {random(pixel, sample, 2 * pair, seed), random(pixel, sample, 2 * pair + 1, seed)};
}

}  // namespace eyeray::reference
