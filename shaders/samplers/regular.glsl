// The centre of each cell.
#ifndef REGULAR_GLSL
#define REGULAR_GLSL
#include "math/rng.glsl"
#include "samplers/grid.glsl"

SHADER_BEGIN

vec2 regular_position(Frame frame, uint pixel, uint index) { return in_grid(frame, index, vec2(0.5f, 0.5f)); }
vec2 regular_pair(Frame frame, uint pixel, uint index, uint pair) { return independent_pair(pixel, index, pair, frame.seed); }

SHADER_END
#endif
