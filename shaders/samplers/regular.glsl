// The centre of each cell.
#ifndef REGULAR_GLSL
#define REGULAR_GLSL
#include "records.h"

SHADER_BEGIN

vec2 regular_in_cell(Frame frame, uint pixel, uint index) { return vec2(0.5f, 0.5f); }

SHADER_END
#endif
