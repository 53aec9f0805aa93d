// A random place of each cell.
#ifndef JITTERED_GLSL
#define JITTERED_GLSL
#include "math/rng.glsl"
#include "records.h"

SHADER_BEGIN

vec2 jittered_in_cell(Frame frame, uint pixel, uint index) {
  return vec2(random_number(pixel, index, 0u, frame.seed), random_number(pixel, index, 1u, frame.seed));
}

SHADER_END
#endif
