// A random point of each cell.
#ifndef JITTERED_GLSL
#define JITTERED_GLSL
#include "math/rng.glsl"
#include "samplers/grid.glsl"

SHADER_BEGIN

vec2 jittered_position(Frame frame, uint pixel, uint index) {
  return in_grid(frame, index, independent_pair(pixel, index, PAIR_POSITION, frame.seed));
}
vec2 jittered_pair(Frame frame, uint pixel, uint index, uint pair) { return independent_pair(pixel, index, pair, frame.seed); }

SHADER_END
#endif
