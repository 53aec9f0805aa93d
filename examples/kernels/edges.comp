// Finds the edges of a picture by Sobel's filter: the horizontal and the vertical difference of brightness
// around each texel. Both are images, and the picture is read texel by texel.
#version 450
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1, r32f) writeonly uniform image2D edges;

// The brightness of a texel; beyond the border it is that of the nearest one.
float brightness(ivec2 at) {
  const vec3 colour = texelFetch(picture, clamp(at, ivec2(0), textureSize(picture, 0) - 1), 0).rgb;
  return 0.25 * colour.r + 0.625 * colour.g + 0.125 * colour.b;
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(edges);
  if (at.x >= size.x || at.y >= size.y) return;
  float across = 0.0, down = 0.0;
  for (int i = -1; i <= 1; ++i) {
    const float weight = i == 0 ? 2.0 : 1.0;
    across += weight * (brightness(at + ivec2(1, i)) - brightness(at + ivec2(-1, i)));
    down += weight * (brightness(at + ivec2(i, 1)) - brightness(at + ivec2(i, -1)));
  }
  imageStore(edges, at, vec4(abs(across) + abs(down)));
}
