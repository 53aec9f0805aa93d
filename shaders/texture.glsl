// Colours that vary over a surface.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "math.glsl"
#include "records.h"

SHADER_BEGIN

// Whether the check that holds (u, v) is odd. The parity is taken in floats, where an int could overflow.
bool odd_check(Texture texture, vec2 uv) {
  float check = floor(uv.x * texture.frequency.x) + floor(uv.y * texture.frequency.y);
  return check - 2.0f * floor(0.5f * check) != 0.0f;
}

#if HAS_IMAGES
// x as it lies within the image, in [0, 1]: 0 is its first edge, 1 its last. What is no number is 0.
float fold(float x, uint wrap) {
  float repeated = x - floor(x);
  float mirrored = x - 2.0f * floor(0.5f * x);
  mirrored = mirrored > 1.0f ? 2.0f - mirrored : mirrored;
  float folded = wrap == WRAP_REPEAT ? repeated : wrap == WRAP_MIRROR ? mirrored : x;
  return folded > 0.0f ? minimum(folded, 1.0f) : 0.0f;
}

// The texel that is shown at i of `size`, −1 ≤ i ≤ size: beyond an edge, the one at the other edge where images repeat, else
// that edge's own. Whatever i is, the result is a texel.
uint texel_within(int i, uint size, uint wrap) {
  bool repeats = wrap == WRAP_REPEAT;
  uint before = repeats ? size - 1u : 0u;
  uint behind = repeats ? 0u : size - 1u;
  return i < 0 ? before : uint(i) >= size ? behind : uint(i);
}

// Linear RGB of the texel at `column` and `row`, counted from the lower left.
vec3 texel_color(Texture texture, uint column, uint row) {
  uint table = (texture.image.w & IMAGE_LINEAR) != 0u ? TEXELS_LINEAR : TEXELS_SRGB;
  uint texel = load_texel(texture.image.z + (texture.image.y - 1u - row) * texture.image.x + column);
  return vec3(uintBitsToFloat(load_texel(table + (texel & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 8u) & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 16u) & 255u))));
}

// The mean of four texels, by how near their centres are, which lie at half-integers; or nearest, all of the one that holds
// (u, v). Folding comes first, in the image's own unit, where a float is most exact.
vec3 image_color(Texture texture, vec2 uv) {
  bool nearest = (texture.image.w & IMAGE_NEAREST) != 0u;
  uint wrap_u = (texture.image.w >> IMAGE_WRAP_U_SHIFT) & IMAGE_WRAP_MASK;
  uint wrap_v = (texture.image.w >> IMAGE_WRAP_V_SHIFT) & IMAGE_WRAP_MASK;
  float centre = nearest ? 0.0f : 0.5f;
  float x = fold(uv.x * texture.frequency.x, wrap_u) * float(texture.image.x) - centre;
  float y = fold(uv.y * texture.frequency.y, wrap_v) * float(texture.image.y) - centre;
  float to_right = nearest ? 0.0f : x - floor(x);
  float to_top = nearest ? 0.0f : y - floor(y);

  uint left = texel_within(int(floor(x)), texture.image.x, wrap_u);
  uint right = texel_within(int(floor(x)) + 1, texture.image.x, wrap_u);
  uint bottom = texel_within(int(floor(y)), texture.image.y, wrap_v);
  uint top = texel_within(int(floor(y)) + 1, texture.image.y, wrap_v);
  vec3 bottom_left = texel_color(texture, left, bottom);
  vec3 top_left = texel_color(texture, left, top);
  vec3 lower = bottom_left + (texel_color(texture, right, bottom) - bottom_left) * to_right;
  vec3 upper = top_left + (texel_color(texture, right, top) - top_left) * to_right;
  return lower + (upper - lower) * to_top;
}
#endif

vec3 texture_color(uint index, vec2 uv) {
  Texture texture = load_texture(index);
  vec3 color = vec3(texture.even);
#if HAS_CHECKER
  if (texture.even.w == TEXTURE_CHECKER && odd_check(texture, uv)) color = vec3(texture.odd);
#endif
#if HAS_IMAGES
  if (texture.even.w == TEXTURE_IMAGE) color = color * image_color(texture, uv);
#endif
  return color;
}

SHADER_END
#endif
