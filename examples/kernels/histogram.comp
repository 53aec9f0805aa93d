// Counts the bytes of a buffer of words, first within each work group.
#version 450
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Words { uint words[]; };
layout(std430, binding = 1) buffer Bins { uint bins[256]; };

shared uint counts[256];

void main() {
  counts[gl_LocalInvocationID.x] = 0;
  barrier();
  const uint word = words[gl_GlobalInvocationID.x];
  for (int shift = 0; shift < 32; shift += 8) atomicAdd(counts[word >> shift & 255u], 1);
  barrier();
  atomicAdd(bins[gl_LocalInvocationID.x], counts[gl_LocalInvocationID.x]);
}
