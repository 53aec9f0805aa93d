// Sobol': On the distribution of points in a cube, USSR Comp. Math. 7(4), 1967, by its direction numbers;
// Owen: Randomly permuted (t,m,s)-nets, 1995, by the hash of Burley: Practical Hash-based Owen Scrambling,
// JCGT 9(4), 2020.
#include "host/reference/rng.hpp"
#include "host/reference/sampler.hpp"

namespace eyeray::engine::reference {

extern const Sampler sobol_sampler;

namespace {

constexpr std::string_view manual =
    "Sobol's sequence with Owen's scrambling, selected by `seed` of [render](#render). The samples of a "
    "pixel, and their paths, are evenly distributed for any number of samples. Powers of two are best.";

uint32_t reversed(uint32_t x) {
  uint32_t result = 0;
  for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1) << (31 - bit);
  return result;
}

// Scrambles a binary fraction of 32 bits: a hash of all bits before a bit decides whether that bit is
// flipped.
uint32_t scrambled(uint32_t x, uint32_t seed) {
  uint32_t r = reversed(x) + seed;
  for (const uint32_t factor : {0x6c50b47cu, 0xb82f1e52u, 0xc7afe638u, 0x8d22f6e6u}) r ^= r * factor;
  return reversed(r);
}

// The coordinate of point `index` in dimension 0 or 1, as a binary fraction of 32 bits.
uint32_t sobol(uint32_t index, int dimension) {
  uint32_t result = 0;
  uint32_t direction = 1u << 31;
  for (; index != 0; index >>= 1) {
    if (index & 1) result ^= direction;
    direction = dimension == 0 ? direction >> 1 : direction ^ direction >> 1;
  }
  return result;
}

Vec2 pair(uint32_t pixel, uint32_t index, uint32_t pair, uint32_t seed) {
  const uint32_t own = pcg(pixel + pcg(pair + pcg(seed)));
  const uint32_t shuffled = scrambled(index, pcg(own ^ 0x9e3779b9u));
  return {fraction(scrambled(sobol(shuffled, 0), pcg(own ^ 0x85ebca6bu))),
          fraction(scrambled(sobol(shuffled, 1), pcg(own ^ 0xc2b2ae35u)))};
}

}  // namespace

extern const Sampler sobol_sampler{.manual = manual,
                                   .position = [](int, uint32_t pixel, uint32_t index,
                                                  uint32_t seed) { return pair(pixel, index, 0, seed); },
                                   .pair = pair};

}  // namespace eyeray::engine::reference
