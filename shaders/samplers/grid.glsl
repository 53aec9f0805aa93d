// Functions shared by samplers that divide a pixel into n × n cells.
#ifndef GRID_GLSL
#define GRID_GLSL
#include "records.h"

SHADER_BEGIN

// The point in the pixel that lies at `in_cell` of cell `index`.
vec2 in_grid(Frame frame, uint index, vec2 in_cell) {
  uint n = frame.samples_per_side;
  return vec2((float(index % n) + in_cell.x) / float(n), (float(index / n) + in_cell.y) / float(n));
}

SHADER_END
#endif
