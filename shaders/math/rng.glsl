// Counter-based random numbers: a function of pixel, sample, dimension and seed, in integers only, so that every executor draws
// the same. The hash is O'Neill's PCG output permutation, as Jarzynski and Olano recommend ("Hash Functions for GPU
// Rendering", JCGT 2020).
#ifndef RNG_GLSL
#define RNG_GLSL
#include "language.h"

SHADER_BEGIN

uint pcg_hash(uint x) {
  uint state = x * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// In [0, 1), a multiple of 2^-24.
float random_number(uint pixel, uint sample_index, uint dimension, uint seed) {
  uint bits = pcg_hash(pixel + pcg_hash(sample_index + pcg_hash(dimension + pcg_hash(seed))));
  return float(bits >> 8u) * 5.9604645e-8f;
}

SHADER_END
#endif
