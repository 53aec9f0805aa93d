// Independent random numbers.
#ifndef RANDOM_GLSL
#define RANDOM_GLSL
#include "math/rng.glsl"
#include "records.h"

SHADER_BEGIN

vec2 random_position(Frame frame, uint pixel, uint index) { return independent_pair(pixel, index, PAIR_POSITION, frame.seed); }
vec2 random_pair(Frame frame, uint pixel, uint index, uint pair) { return independent_pair(pixel, index, pair, frame.seed); }

SHADER_END
#endif
