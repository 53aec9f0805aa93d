// Known answers: host/gpu/self_test.cpp requires them of a driver before anything is rendered on it. Every invocation does each
// operation once on inputs from a buffer, so that no compiler can know the results.
#version 450
#include "math/device.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Sizes {
  uint count;            // count of invocations; inputs are count each of a, b and c
  uint loop_iterations;  // more than some drivers are willing to make
};

uint hash(uint x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  float a = uintBitsToFloat(inputs[i]);
  float b = uintBitsToFloat(inputs[count + i]);
  float c = uintBitsToFloat(inputs[2u * count + i]);
  outputs[10u * i + 0u] = hash(i ^ inputs[i]);
  outputs[10u * i + 1u] = inputs[count - 1u - i];
  outputs[10u * i + 2u] = floatBitsToUint(a + b);
  outputs[10u * i + 3u] = floatBitsToUint(a - b);
  outputs[10u * i + 4u] = floatBitsToUint(a * b);
  outputs[10u * i + 5u] = floatBitsToUint(a / b);
  outputs[10u * i + 6u] = floatBitsToUint(sqrt(abs(a)));
  outputs[10u * i + 7u] = floatBitsToUint(a * b + c);
  outputs[10u * i + 8u] = floatBitsToUint(floor(a));
  outputs[10u * i + 9u] = (a < b ? 1u : 0u) | (a <= b ? 2u : 0u) | (a == b ? 4u : 0u) | (a != b ? 8u : 0u);

  // A loop whose end cannot be computed ahead.
  if (i > 0u) return;
  uint state = 0u;
  uint made = 0u;
  for (; made < loop_iterations; ++made) state = state * 1664525u + 1013904223u;
  outputs[10u * count + 0u] = made;
  outputs[10u * count + 1u] = state;
}
