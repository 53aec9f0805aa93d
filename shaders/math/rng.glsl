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

// The uses of pairs of random numbers. Each use has its own pair, on every path.
#define PAIR_POSITION 0u  // in the pixel
#define PAIR_LENS 1u      // and on the lens
#define PAIR_SCATTER 4u   // at the first vertex: which lobe, and whether the path ends; PAIRS_A_VERTEX further on those of the next
#define PAIR_DIRECTION 5u
#define PAIR_LIGHT 6u     // which light
#define PAIR_EMITTER 7u   // where on it
#define PAIRS_A_VERTEX 4u
#define PHOTONS_OF 0x80000000u  // + a sample's number: for its photons, in place of a pixel; a photon's number is in place of a sample's
#define PAIR_SIDE 3u            // for a photon: which side of a surface it leaves, and its target; before that, …
#define PAIR_SOURCE 0u          // … which light, …
#define PAIR_START 1u           // … where on it or from where around, …
#define PAIR_HEADING 2u         // … and where to
#define PAIR_CHANNEL 0xffffu   // by which colour channel's index the path is refracted
#define PAIR_FLIGHT 0x10000u  // how far the path gets on its way to the first vertex; one further on to the next

#define ALPHA_KEYS 0x80000000u  // in place of a dimension, + a path's depth · 2^16: of its ray; one further on each of its shadow rays

// The upper 24 bits as a number in [0, 1): exactly.
float unit_float(uint bits) { return float(bits >> 8u) * 5.9604645e-8f; }

// In [0, 1), a multiple of 2^-24.
float random_number(uint pixel, uint sample_index, uint dimension, uint seed) {
  return unit_float(pcg_hash(pixel + pcg_hash(sample_index + pcg_hash(dimension + pcg_hash(seed)))));
}

vec2 independent_pair(uint pixel, uint sample_index, uint pair, uint seed) {
  return vec2(random_number(pixel, sample_index, 2u * pair, seed), random_number(pixel, sample_index, 2u * pair + 1u, seed));
}

SHADER_END
#endif
