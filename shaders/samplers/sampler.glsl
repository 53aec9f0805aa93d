// The positions of a pixel's samples in the picture, and the random numbers of their paths, by the sampler.
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL
#include "kernels/features.h"
#include "records.h"
#include "samplers/filter.glsl"

SHADER_BEGIN

// The position of sample `index` of pixel (x, y), in pixels from the picture's top left.
vec2 sample_position(Frame frame, uint x, uint y, uint index) {
  uint pixel = y * frame.width + x;
  vec2 position = vec2(0.5f, 0.5f);
#define POSITION_OF(name, number, count) \
  if (SAMPLER_IS(number)) position = name##_position(frame, pixel, index);
  SAMPLERS(POSITION_OF)
#if HAS_FILTER
  position = filtered(frame, position);
#endif
  return vec2(float(x) + position.x, float(y) + position.y);
}

// A pair of random numbers in [0, 1), multiples of 2^-24, for one use of a sample: a PAIR_ of math/rng.glsl, of a vertex after the first
// PAIRS_A_VERTEX further on.
vec2 sample_pair(Frame frame, uint pixel, uint index, uint pair) {
  vec2 numbers = vec2(0.5f, 0.5f);
#define PAIR_OF(name, number, count) \
  if (SAMPLER_IS(number)) numbers = name##_pair(frame, pixel, index, pair);
  SAMPLERS(PAIR_OF)
  return numbers;
}

SHADER_END
#endif
