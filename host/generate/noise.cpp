#include "host/generate/noise.hpp"

#include <cmath>

namespace eyeray::engine::generate {
namespace {

// PCG's output permutation (Jarzynski, Olano: Hash Functions for GPU Rendering, JCGT 9(3), 2020).
uint32_t hash(uint32_t x) {
  const uint32_t state = x * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double at_lattice(int64_t x, int64_t y, uint32_t seed) {
  const uint32_t bits = hash(uint32_t(x) + hash(uint32_t(y) + hash(seed)));
  return bits * 0x1p-31 - 1;
}

}  // namespace

Noise noise(const Vec2& p, uint32_t seed) {
  const Vec2 cell = glm::floor(p);
  const Vec2 f = p - cell;
  const Vec2 fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  const Vec2 slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);

  const int64_t x = int64_t(cell.x), y = int64_t(cell.y);
  const double a = at_lattice(x, y, seed), b = at_lattice(x + 1, y, seed);
  const double c = at_lattice(x, y + 1, seed), d = at_lattice(x + 1, y + 1, seed);
  const double twist = a - b - c + d;
  return {a + (b - a) * fade.x + (c - a) * fade.y + twist * fade.x * fade.y,
          slope * Vec2(b - a + twist * fade.y, c - a + twist * fade.x)};
}

}  // namespace eyeray::engine::generate
