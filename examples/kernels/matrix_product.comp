// C = A · B, in tiles of shared memory. TILE is a specialization constant, and so the size of work groups is.
#version 450
layout(constant_id = 0) const uint TILE = 8;
layout(local_size_x = 8, local_size_y = 8, local_size_x_id = 0, local_size_y_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer A { float a[]; };
layout(std430, set = 0, binding = 1) readonly buffer B { float b[]; };
layout(std430, set = 1, binding = 0) writeonly buffer C { float c[]; };
layout(std140, set = 1, binding = 1) uniform Sizes { uint n; } sizes;

shared float part_of_a[TILE][TILE];
shared float part_of_b[TILE][TILE];

void main() {
  const uint n = sizes.n, row = gl_GlobalInvocationID.y, column = gl_GlobalInvocationID.x;
  const uint y = gl_LocalInvocationID.y, x = gl_LocalInvocationID.x;
  float sum = 0;
  for (uint k = 0; k < n; k += TILE) {
    part_of_a[y][x] = a[row * n + k + x];
    part_of_b[y][x] = b[(k + y) * n + column];
    barrier();
    for (uint i = 0; i < TILE; ++i) sum += part_of_a[y][i] * part_of_b[i][x];
    barrier();
  }
  c[row * n + column] = sum;
}
