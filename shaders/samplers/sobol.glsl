// Sobol's sequence in two dimensions, scrambled as Owen does, for each pixel and each pair anew: any stretch of 2^k samples from a multiple
// of 2^k on is evenly spread. Pairs are independent of each other, since each has its own order ("padding").
// Burley, "Practical Hash-based Owen Scrambling" (JCGT 2020).
#ifndef SOBOL_GLSL
#define SOBOL_GLSL
#include "math/rng.glsl"
#include "records.h"

SHADER_BEGIN

uint reversed_bits(uint x) {
  x = (x << 16u) | (x >> 16u);
  x = ((x & 0x00ff00ffu) << 8u) | ((x >> 8u) & 0x00ff00ffu);
  x = ((x & 0x0f0f0f0fu) << 4u) | ((x >> 4u) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2u) | ((x >> 2u) & 0x33333333u);
  return ((x & 0x55555555u) << 1u) | ((x >> 1u) & 0x55555555u);
}

// Owen's scrambling of a number whose bits are reversed: each new bit depends only on the bits below it. Laine and Karras, "Stratified
// Sampling for Stochastic Transparency" (EGSR 2011), with Burley's constants.
uint owen_scrambled(uint x, uint seed) {
  x = x + seed;
  x = x ^ (x * 0x6c50b47cu);
  x = x ^ (x * 0xb82f1e52u);
  x = x ^ (x * 0xc7afe638u);
  return x ^ (x * 0x8d22f6e6u);
}

// Sobol's second dimension of the number whose bits, reversed, are x: Pascal's triangle modulo 2.
uint sobol_second(uint x) {
  x = x ^ (x << 16u);
  x = x ^ ((x & 0x00ff00ffu) << 8u);
  x = x ^ ((x & 0x0f0f0f0fu) << 4u);
  x = x ^ ((x & 0x33333333u) << 2u);
  return x ^ ((x & 0x55555555u) << 1u);
}

vec2 sobol_pair(Frame frame, uint pixel, uint index, uint pair) {
  uint seed = pcg_hash(pixel + pcg_hash(pair + pcg_hash(frame.seed)));
  uint shuffled = reversed_bits(owen_scrambled(reversed_bits(index), pcg_hash(seed ^ 0x9e3779b9u)));
  uint first = reversed_bits(owen_scrambled(shuffled, pcg_hash(seed ^ 0x85ebca6bu)));
  uint second = sobol_second(reversed_bits(shuffled));
  second = reversed_bits(owen_scrambled(reversed_bits(second), pcg_hash(seed ^ 0xc2b2ae35u)));
  return vec2(unit_float(first), unit_float(second));
}

vec2 sobol_position(Frame frame, uint pixel, uint index) { return sobol_pair(frame, pixel, index, PAIR_POSITION); }

SHADER_END
#endif
