#include "host/reference/rng.hpp"

namespace eyeray::engine::reference {

uint32_t pcg(uint32_t x) {
  const uint32_t state = x * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double fraction(uint32_t bits) {
  return (bits >> 8) * 0x1p-24;
}

namespace {

constexpr uint32_t alpha_keys = 0x80000000;  // beyond all dimensions of random numbers

uint32_t bits(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed) {
  return pcg(pixel + pcg(sample + pcg(dimension + pcg(seed))));
}

}  // namespace

double random(uint32_t pixel, uint32_t sample, uint32_t dimension, uint32_t seed) {
  return fraction(bits(pixel, sample, dimension, seed));
}

uint32_t alpha_key(uint32_t pixel, uint32_t sample, uint32_t surfaces, uint32_t number, uint32_t seed) {
  return bits(pixel, sample, alpha_keys + (surfaces << 16) + number, seed);
}

double least_alpha(uint32_t key, uint64_t primitive) {
  return fraction(pcg(key + pcg(uint32_t(primitive)))) + 0x1p-24;
}

Vec2 random_pair(uint32_t pixel, uint32_t sample, uint32_t pair, uint32_t seed) {
  return {random(pixel, sample, 2 * pair, seed), random(pixel, sample, 2 * pair + 1, seed)};
}

}  // namespace eyeray::engine::reference
