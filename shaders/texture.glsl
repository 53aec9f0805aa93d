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

vec3 texture_color(uint index, vec2 uv) {
  Texture texture = load_texture(index);
#if HAS_CHECKER
  bool odd = texture.even.w == TEXTURE_CHECKER && odd_check(texture, uv);
  return odd ? vec3(texture.odd) : vec3(texture.even);
#else
  return vec3(texture.even);
#endif
}

SHADER_END
#endif
