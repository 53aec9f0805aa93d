// Sums of all numbers up to each one, within a work group (Hillis and Steele).
#version 450
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Numbers { uint numbers[]; };
layout(std430, binding = 1) writeonly buffer Sums { uint sums[]; };

shared uint list[256];

void main() {
  const uint local = gl_LocalInvocationID.x, i = gl_GlobalInvocationID.x;
  list[local] = numbers[i];
  barrier();
  for (uint step = 1; step < 256; step *= 2) {
    const uint before = local >= step ? list[local - step] : 0;
#ifndef RACE
    barrier();  // without it, a number is overwritten while another invocation reads it
#endif
    list[local] += before;
    barrier();
  }
  sums[i] = list[local];
}
