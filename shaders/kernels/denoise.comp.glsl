// Entry: one stage of denoising on a tile of the picture, one invocation a pixel. In the first three stages each row of workgroups has another
// neighbour. A define chooses the stage, in this order:
// DIFFERENCES compares each pixel with its neighbour, also PATCH_RADIUS pixels beyond the tile.
// ROW_SUMS adds up the differences of each row of a patch.
// DISTANCES writes the distances of patches over the differences.
// AVERAGE adds half of the weighted mean of the features to the results.
// FIT fits the colours, of which there are COLORS, by a linear function of the features.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "denoise/distance.glsl"
#include "denoise/regression.glsl"
#include "denoise/step.h"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_COMPARED) readonly restrict buffer Compared { float compared[]; };
layout(std430, binding = BINDING_VARIANCES) readonly restrict buffer Variances { float variances[]; };
layout(std430, binding = BINDING_COUNTING) readonly restrict buffer Counting { float counting[]; };
layout(std430, binding = BINDING_DISTANCES) restrict buffer Distances { float distances[]; };
layout(std430, binding = BINDING_ROW_SUMS) restrict buffer RowSums { float row_sums[]; };
layout(std430, binding = BINDING_VALUES) readonly restrict buffer Values { float values[]; };
layout(std430, binding = BINDING_FEATURES) readonly restrict buffer Features { float features[]; };
layout(std430, binding = BINDING_DENOISED) restrict buffer Denoised { float denoised[]; };
layout(push_constant) uniform PushConstants { DenoiseStep denoise; };

// The tile with PATCH_RADIUS more pixels on each side.
uint wide() { return denoise.width + 2u * PATCH_RADIUS; }
uint high() { return denoise.height + 2u * PATCH_RADIUS; }
uint own_neighbour() { return denoise.neighbour + gl_WorkGroupID.y; }
uint neighbours() { return (2u * denoise.radius + 1u) * (2u * denoise.radius + 1u); }

// Inputs: the distance between two rows and two planes, and the index of a pixel, whose coordinates count from the margin's corner.
uint row_step() { return denoise.width + 2u * DENOISE_MARGIN; }
uint plane_step() { return row_step() * (denoise.height + 2u * DENOISE_MARGIN); }
uint input_at(uint x, uint y) { return y * row_step() + x; }

// The neighbour of a number: its displacement, and radius more, along each axis.
uvec2 neighbour(uint number) {
  uint across = 2u * denoise.radius + 1u;
  uint row = quotient(number, across);
  return uvec2(number - row * across, row);
}
// The input of the neighbour of the pixel at (x, y), which count from the tile's corner less PATCH_RADIUS.
uint input_of(uint x, uint y, uvec2 moved) {
  uint margin = WINDOW_RADIUS - denoise.radius;
  return input_at(x + margin + moved.x, y + margin + moved.y);
}
uint distance_at(uint number, uint x, uint y) { return (number * high() + y + PATCH_RADIUS) * wide() + x + PATCH_RADIUS; }

#ifdef DIFFERENCES
void compute(uint i) {
  uint y = quotient(i, wide());
  uint x = i - y * wide();
  if (y >= high()) return;
  uint here = input_at(x + WINDOW_RADIUS, y + WINDOW_RADIUS);
  uint there = input_of(x, y, neighbour(own_neighbour()));
  float sum = 0.0f;
  for (uint plane = 0u; plane < denoise.compared; ++plane) {
    uint start = plane * plane_step();
    sum += patch_difference(compared[start + here], compared[start + there], variances[start + here], variances[start + there], denoise.least);
  }
  distances[(own_neighbour() * high() + y) * wide() + x] = sum * (counting[here] * counting[there]);
}
#endif

#ifdef ROW_SUMS
void compute(uint i) {
  uint y = quotient(i, denoise.width);
  uint x = i - y * denoise.width;
  if (y >= high()) return;
  uint start = (own_neighbour() * high() + y) * wide() + x;
  float sum = 0.0f;
  UNROLL for (uint k = 0u; k < PATCH; ++k) sum += distances[start + k];
  row_sums[(own_neighbour() * high() + y) * denoise.width + x] = sum;
}
#endif

#ifdef DISTANCES
void compute(uint i) {
  uint y = quotient(i, denoise.width);
  uint x = i - y * denoise.width;
  if (y >= denoise.height) return;
  uint start = (own_neighbour() * high() + y) * denoise.width + x;
  float sum = 0.0f;
  UNROLL for (uint k = 0u; k < PATCH; ++k) sum += row_sums[start + k * denoise.width];
  uint own = distance_at(own_neighbour(), x, y);
  int count = int(denoise.compared);
  float counts = counting[input_of(x + PATCH_RADIUS, y + PATCH_RADIUS, neighbour(own_neighbour()))];
  distances[own] = patch_distance(sum * share_of_patch(count), distances[own] * share_of_own(count), counts);
}
#endif

#ifdef AVERAGE
void compute(uint i) {
  uint y = quotient(i, denoise.width);
  uint x = i - y * denoise.width;
  if (y >= denoise.height) return;
  float sums[FEATURES];
  UNROLL for (uint f = 0u; f < FEATURES; ++f) sums[f] = 0.0f;
  float weights = LEAST_WEIGHT;
  for (uint number = 0u; number < neighbours(); ++number) {
    float weight = neighbour_weight(denoise.strictness * distances[distance_at(number, x, y)]);
    uint there = input_of(x + PATCH_RADIUS, y + PATCH_RADIUS, neighbour(number));
    weights += weight;
    UNROLL for (uint f = 0u; f < FEATURES; ++f) sums[f] += weight * values[f * plane_step() + there];
  }
  UNROLL for (uint f = 0u; f < FEATURES; ++f) denoised[(f * denoise.height + y) * denoise.width + x] += half_of_mean(sums[f], weights);
}
#endif

#ifdef FIT
void compute(uint i) {
  uint y = quotient(i, denoise.width);
  uint x = i - y * denoise.width;
  if (y >= denoise.height) return;
  uint here = input_at(x + DENOISE_MARGIN, y + DENOISE_MARGIN);
  NormalEquations sums;
  UNROLL for (uint k = 0u; k < PRODUCTS; ++k) sums.matrix[k] = 0.0f;
  UNROLL for (uint k = 0u; k < UNKNOWNS * MOST_COLORS; ++k) sums.sides[k] = 0.0f;
  for (uint number = 0u; number < neighbours(); ++number) {
    float weight = neighbour_weight(denoise.strictness * distances[distance_at(number, x, y)]);
    if (weight == 0.0f) continue;
    uint there = input_of(x + PATCH_RADIUS, y + PATCH_RADIUS, neighbour(number));
    float terms[FEATURES];
    float colors[MOST_COLORS];
    UNROLL for (uint f = 0u; f < FEATURES; ++f) terms[f] = features[f * plane_step() + there] - features[f * plane_step() + here];
    UNROLL for (uint c = 0u; c < COLORS; ++c) colors[c] = values[c * plane_step() + there];
    add_neighbour(sums, weight, terms, colors, COLORS);
  }
  solve(sums, COLORS);
  UNROLL for (uint c = 0u; c < COLORS; ++c)
    denoised[((denoise.first + c) * denoise.height + y) * denoise.width + x] = sums.sides[SIDE(FEATURES, c)];
}
#endif

void main() { compute(gl_GlobalInvocationID.x); }
