// Colours that vary over a surface.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "math/math.glsl"
#include "records.h"

SHADER_BEGIN

// Whether the check that holds (u, v) is odd. The parity is taken in floats, where an int could overflow.
bool odd_check(Texture texture, vec2 uv) {
  float check = floor(uv.x * texture.frequency_u) + floor(uv.y * texture.frequency_v);
  return check - 2.0f * floor(0.5f * check) != 0.0f;
}

#if HAS_IMAGES
// x within the copy of the image that it lies in, in [0, 1] from the copy's first edge to its last. What is no number is 0.
float within_copy(float x, uint wrap) {
  float within = wrap == WRAP_CLAMP ? x : x - floor(x);
  return within > 0.0f ? minimum(within, 1.0f) : 0.0f;
}

// Whether that copy is a mirrored one.
bool mirrored_copy(float x, uint wrap) {
  float copy = floor(x);
  return wrap == WRAP_MIRROR && copy - 2.0f * floor(0.5f * copy) != 0.0f;
}

// The texel of `size` at i of a copy, −1 ≤ i ≤ size: beyond an edge, the first of the next copy. The result is one whatever i is.
uint copied_texel(int i, uint size, uint wrap, bool mirrored) {
  bool repeats = wrap == WRAP_REPEAT;
  uint before = repeats ? size - 1u : 0u;
  uint behind = repeats ? 0u : size - 1u;
  uint texel = i < 0 ? before : uint(i) >= size ? behind : uint(i);
  return mirrored ? size - 1u - texel : texel;
}

// The codes of the texel at `column` and `row`, counted from the lower left.
uint texel_codes(Texture texture, uint column, uint row) {
  return load_texel(texture.first_texel + (texture.height - 1u - row) * texture.width + column);
}

// Linear RGB of it.
vec3 texel_color(Texture texture, uint column, uint row) {
  uint table = (texture.flags & IMAGE_LINEAR) != 0u ? TEXELS_LINEAR : TEXELS_SRGB;
  uint texel = texel_codes(texture, column, row);
  return vec3(uintBitsToFloat(load_texel(table + (texel & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 8u) & 255u))),
              uintBitsToFloat(load_texel(table + ((texel >> 16u) & 255u))));
}

// The four texels whose mean is an image at (u, v), by how near their centres are, which lie at half-integers; or nearest, all of the one
// that holds (u, v). The place within a copy is found first, in the image's own unit, where that costs no precision.
struct TexelQuad {
  uint left;
  uint right;
  uint bottom;
  uint top;
  float to_right;
  float to_top;
};

TexelQuad image_place(Texture texture, vec2 uv) {
  float u = uv.x * texture.frequency_u;
  float v = uv.y * texture.frequency_v;
  uint wrap_u = (texture.flags >> IMAGE_WRAP_U_SHIFT) & IMAGE_WRAP_MASK;
  uint wrap_v = (texture.flags >> IMAGE_WRAP_V_SHIFT) & IMAGE_WRAP_MASK;
  bool nearest = (texture.flags & IMAGE_NEAREST) != 0u;
  float centre = nearest ? 0.0f : 0.5f;
  float x = within_copy(u, wrap_u) * float(texture.width) - centre;
  float y = within_copy(v, wrap_v) * float(texture.height) - centre;
  TexelQuad place;
  place.to_right = nearest ? 0.0f : x - floor(x);
  place.to_top = nearest ? 0.0f : y - floor(y);

  bool mirrored_u = mirrored_copy(u, wrap_u);
  bool mirrored_v = mirrored_copy(v, wrap_v);
  place.left = copied_texel(int(floor(x)), texture.width, wrap_u, mirrored_u);
  place.right = copied_texel(int(floor(x)) + 1, texture.width, wrap_u, mirrored_u);
  place.bottom = copied_texel(int(floor(y)), texture.height, wrap_v, mirrored_v);
  place.top = copied_texel(int(floor(y)) + 1, texture.height, wrap_v, mirrored_v);
  return place;
}

vec3 image_color(Texture texture, vec2 uv) {
  TexelQuad at = image_place(texture, uv);
  vec3 bottom_left = texel_color(texture, at.left, at.bottom);
  vec3 top_left = texel_color(texture, at.left, at.top);
  vec3 lower = bottom_left + (texel_color(texture, at.right, at.bottom) - bottom_left) * at.to_right;
  vec3 upper = top_left + (texel_color(texture, at.right, at.top) - top_left) * at.to_right;
  return lower + (upper - lower) * at.to_top;
}

#if HAS_ALPHA_TEST
float texel_alpha(Texture texture, uint column, uint row) {
  return uintBitsToFloat(load_texel(TEXELS_LINEAR + (texel_codes(texture, column, row) >> 24u)));
}

float image_alpha(Texture texture, vec2 uv) {
  TexelQuad at = image_place(texture, uv);
  float bottom_left = texel_alpha(texture, at.left, at.bottom);
  float top_left = texel_alpha(texture, at.left, at.top);
  float lower = bottom_left + (texel_alpha(texture, at.right, at.bottom) - bottom_left) * at.to_right;
  float upper = top_left + (texel_alpha(texture, at.right, at.top) - top_left) * at.to_right;
  return lower + (upper - lower) * at.to_top;
}
#endif
#endif

vec3 texture_color(uint index, vec2 uv) {
  Texture texture = load_texture(index);
  vec3 color = texture.even;
#if HAS_CHECKER
  if (texture.kind == TEXTURE_CHECKER && odd_check(texture, uv)) color = texture.odd;
#endif
#if HAS_IMAGES
  if (texture.kind == TEXTURE_IMAGE) color = color * image_color(texture, uv);
#endif
  return color;
}

#if HAS_ALPHA_TEST
// A texture as an alpha: the first component of a constant or a check; an image's alpha times that.
float texture_alpha(uint index, vec2 uv) {
  Texture texture = load_texture(index);
  float alpha = texture.even.x;
#if HAS_CHECKER
  if (texture.kind == TEXTURE_CHECKER && odd_check(texture, uv)) alpha = texture.odd.x;
#endif
#if HAS_IMAGES
  if (texture.kind == TEXTURE_IMAGE) alpha = alpha * image_alpha(texture, uv);
#endif
  return alpha;
}
#endif

SHADER_END
#endif
