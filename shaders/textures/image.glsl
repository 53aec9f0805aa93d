// A picture. color: a factor of its texels.
#ifndef IMAGE_GLSL
#define IMAGE_GLSL
#include "math/math.glsl"
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

vec2 image_copies(Texture texture) { return vec2(texture.b); }  // per unit of u and of v
vec2 image_shift(Texture texture) { return vec2(texture.b.z, texture.b.w); }  // position in the image, in copies, of uv = (0, 0)
uint image_width(Texture texture) { return texture.c.x; }
uint image_height(Texture texture) { return texture.c.y; }
uint image_first_texel(Texture texture) { return texture.c.z; }
uint image_flags(Texture texture) { return texture.c.w; }

// x within the copy of the image that it lies in, in [0, 1] from the copy's first edge to its last. What is no number is 0.
float within_copy(float x, uint wrap) {
  float within = wrap == WRAP_CLAMP ? x : x - floor(x);
  return within > 0.0f ? minimum(within, 1.0f) : 0.0f;
}

// True if that copy is a mirrored one.
bool mirrored_copy(float x, uint wrap) {
  float copy = floor(x);
  return wrap == WRAP_MIRROR && copy - 2.0f * floor(0.5f * copy) != 0.0f;
}

// The texel of `size` at i of a copy, −1 ≤ i ≤ size: beyond an edge, the first of the next copy. The result is a texel for every i.
uint copied_texel(int i, uint size, uint wrap, bool mirrored) {
  bool repeats = wrap == WRAP_REPEAT;
  uint before = repeats ? size - 1u : 0u;
  uint behind = repeats ? 0u : size - 1u;
  uint texel = i < 0 ? before : uint(i) >= size ? behind : uint(i);
  return mirrored ? size - 1u - texel : texel;
}

// The codes of the texel at `column` and `row`, counted from the lower left.
uint texel_codes(Texture texture, uint column, uint row) {
  return load_texel(image_first_texel(texture) + (image_height(texture) - 1u - row) * image_width(texture) + column);
}

// The texel's linear RGB.
vec3 texel_color(Texture texture, uint column, uint row) {
  uint table = (image_flags(texture) & IMAGE_LINEAR) != 0u ? TEXELS_LINEAR : TEXELS_SRGB;
  uint texel = texel_codes(texture, column, row);
  return vec3(uintBitsToFloat(load_texel(table + (texel & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 8u) & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 16u) & 255u))));
}

// The four texels whose mean, weighted by nearness of their centres, is the image at (u, v); centres lie at half-integers. IMAGE_NEAREST:
// only the one that holds (u, v) counts. The point within a copy is found first, in the image's own unit, where that costs no precision.
struct TexelQuad {
  uint left;
  uint right;
  uint bottom;
  uint top;
  float to_right;
  float to_top;
};

TexelQuad texels_at(Texture texture, vec2 uv) {
  vec2 copies = image_copies(texture);
  vec2 shift = image_shift(texture);
  float u = uv.x * copies.x + shift.x;
  float v = uv.y * copies.y + shift.y;
  uint wrap_u = (image_flags(texture) >> IMAGE_WRAP_U_SHIFT) & IMAGE_WRAP_MASK;
  uint wrap_v = (image_flags(texture) >> IMAGE_WRAP_V_SHIFT) & IMAGE_WRAP_MASK;
  bool nearest = (image_flags(texture) & IMAGE_NEAREST) != 0u;
  float centre = nearest ? 0.0f : 0.5f;
  float x = within_copy(u, wrap_u) * float(image_width(texture)) - centre;
  float y = within_copy(v, wrap_v) * float(image_height(texture)) - centre;
  TexelQuad quad;
  quad.to_right = nearest ? 0.0f : x - floor(x);
  quad.to_top = nearest ? 0.0f : y - floor(y);

  bool mirrored_u = mirrored_copy(u, wrap_u);
  bool mirrored_v = mirrored_copy(v, wrap_v);
  quad.left = copied_texel(int(floor(x)), image_width(texture), wrap_u, mirrored_u);
  quad.right = copied_texel(int(floor(x)) + 1, image_width(texture), wrap_u, mirrored_u);
  quad.bottom = copied_texel(int(floor(y)), image_height(texture), wrap_v, mirrored_v);
  quad.top = copied_texel(int(floor(y)) + 1, image_height(texture), wrap_v, mirrored_v);
  return quad;
}

// The texture coordinates that the image reads.
vec2 image_uv(Texture texture, TextureContext point) {
#if HAS_SECOND_UV
  if (reads_second_uv(texture)) return point.second_uv;
#endif
  return point.uv;
}

vec3 image_color(Texture texture, TextureContext point) {
  TexelQuad at = texels_at(texture, image_uv(texture, point));
  vec3 bottom_left = texel_color(texture, at.left, at.bottom);
  vec3 top_left = texel_color(texture, at.left, at.top);
  vec3 lower = bottom_left + (texel_color(texture, at.right, at.bottom) - bottom_left) * at.to_right;
  vec3 upper = top_left + (texel_color(texture, at.right, at.top) - top_left) * at.to_right;
  return texture.color * (lower + (upper - lower) * at.to_top);
}

float texel_alpha(Texture texture, uint column, uint row) {
  return uintBitsToFloat(load_texel(TEXELS_LINEAR + (texel_codes(texture, column, row) >> 24u)));
}

float image_alpha(Texture texture, TextureContext point) {
  TexelQuad at = texels_at(texture, image_uv(texture, point));
  float bottom_left = texel_alpha(texture, at.left, at.bottom);
  float top_left = texel_alpha(texture, at.left, at.top);
  float lower = bottom_left + (texel_alpha(texture, at.right, at.bottom) - bottom_left) * at.to_right;
  float upper = top_left + (texel_alpha(texture, at.right, at.top) - top_left) * at.to_right;
  return texture.color.x * (lower + (upper - lower) * at.to_top);
}

SHADER_END
#endif
