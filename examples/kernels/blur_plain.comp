// The blur of blur.comp in its plainest form.
#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Source { vec4 source[]; };
layout(std430, binding = 1) writeonly buffer Target { vec4 target[]; };
layout(push_constant) uniform Size { ivec2 size; };

#include "clamped.glsl"

void main() {
  const int i = int(gl_GlobalInvocationID.x);
  if (i >= size.x * size.y) return;
  vec4 sum = vec4(0);
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) sum += source[clamped(ivec2(i % size.x, i / size.x) + ivec2(x, y), size)];
  target[i] = sum / 25.0;
}
