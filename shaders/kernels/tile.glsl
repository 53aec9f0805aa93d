// The pixel of a tile that an invocation computes.
#ifndef TILE_GLSL
#define TILE_GLSL
#include "math/math.glsl"
#include "records.h"

SHADER_BEGIN

// Invocation i of 64 in a block of 8 × 8 pixels: eight neighbouring invocations cover 4 × 2 pixels.
uvec2 pixel_of_block(uint block, uint i, uint tile_width) {
  uint blocks_across = (tile_width + 7u) / 8u;
  uint row = quotient(block, blocks_across);
  return uvec2((block - row * blocks_across) * 8u + ((i & 3u) | ((i & 8u) >> 1u)),
               row * 8u + (((i & 4u) >> 2u) | ((i & 48u) >> 3u)));
}

// Deals the blocks out over `stride` contiguous runs of workgroups: a CPU driver gives each thread one run, and so each gets a fair
// share of sky and glass. `groups` is a multiple of `stride`.
uint swizzled_workgroup(uint group, uint groups, uint stride) {
  uint run = quotient(groups, stride);
  uint which = quotient(group, run);
  return (group - which * run) * stride + which;
}

SHADER_END
#endif
