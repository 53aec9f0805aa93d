// C = A · B in its plainest form.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer A { float a[]; };
layout(std430, binding = 1) readonly buffer B { float b[]; };
layout(std430, binding = 2) writeonly buffer C { float c[]; };

void main() {
  const uint row = gl_GlobalInvocationID.y, column = gl_GlobalInvocationID.x;
  float sum = 0;
  for (uint k = 0; k < 64u; ++k) sum += a[row * 64u + k] * b[k * 64u + column];
  c[row * 64u + column] = sum;
}
