// Blurs a picture: each pixel becomes the mean of the 5 × 5 around it. A work group reads its pixels and those
// around them once, into shared memory.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) writeonly buffer Target { vec4 target[]; };
layout(push_constant) uniform Size { ivec2 size; };

#include "clamped.glsl"

const int radius = 2;
const int side = 8 + 2 * radius;
shared vec4 tile[side * side];

void main() {
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * 8 - radius;
  for (int i = int(gl_LocalInvocationIndex); i < side * side; i += 64)
    tile[i] = source[clamped(corner + ivec2(i % side, i / side), size)];
  barrier();

  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), inner = ivec2(gl_LocalInvocationID.xy);
  if (pixel.x >= size.x || pixel.y >= size.y) return;
  vec4 sum = vec4(0);
  for (int y = 0; y <= 2 * radius; ++y)
    for (int x = 0; x <= 2 * radius; ++x) sum += tile[(inner.y + y) * side + inner.x + x];
  target[pixel.y * size.x + pixel.x] = sum / 25.0;
}
