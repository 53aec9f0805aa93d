// Where in the picture a pixel's samples lie.
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL
#include "records.h"

SHADER_BEGIN

// Where sample `index` of pixel (x, y) lies, in pixels from the picture's top left: in one of n × n cells, where the sampler says.
vec2 sample_position(Frame frame, uint x, uint y, uint index) {
  uint n = frame.samples_per_side;
  uint pixel = y * frame.width + x;
  vec2 in_cell = vec2(0.5f, 0.5f);
#define IN_CELL_OF(name, number) \
  if (SAMPLER_IS(number)) in_cell = name##_in_cell(frame, pixel, index);
  SAMPLERS(IN_CELL_OF)
  return vec2(float(x) + (float(index % n) + in_cell.x) / float(n), float(y) + (float(index / n) + in_cell.y) / float(n));
}

SHADER_END
#endif
