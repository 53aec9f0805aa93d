// Known answers: host/gpu/self_test.cpp requires them of a driver before anything is rendered on it. Every invocation does each
// operation once on inputs from a buffer, so that no compiler can know the results.
#version 450
#include "math/device.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { uint inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { uint outputs[]; };
layout(push_constant) uniform Sizes {
  uint count;            // count of invocations; inputs are count each of a, b and c, then the special ones
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
  outputs[8u * i + 0u] = hash(i ^ inputs[i]);
  outputs[8u * i + 1u] = inputs[count - 1u - i];
  outputs[8u * i + 2u] = floatBitsToUint(a + b);
  outputs[8u * i + 3u] = floatBitsToUint(a - b);
  outputs[8u * i + 4u] = floatBitsToUint(a * b);
  outputs[8u * i + 5u] = floatBitsToUint(a / b);
  outputs[8u * i + 6u] = floatBitsToUint(sqrt(abs(a)));
  outputs[8u * i + 7u] = floatBitsToUint(a * b + c);

  // The special ones: half of a denormal, one divided by zero, and a loop whose end cannot be computed ahead.
  if (i > 0u) return;
  float denormal = uintBitsToFloat(inputs[3u * count]);
  float zero = uintBitsToFloat(inputs[3u * count + 1u]);
  outputs[8u * count + 0u] = floatBitsToUint(denormal * 0.5);
  outputs[8u * count + 1u] = floatBitsToUint(1.0 / zero);
  uint state = 0u;
  uint made = 0u;
  for (; made < loop_iterations; ++made) state = state * 1664525u + 1013904223u;
  outputs[8u * count + 2u] = made;
  outputs[8u * count + 3u] = state;
}
