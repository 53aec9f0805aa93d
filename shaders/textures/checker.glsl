// A checkerboard. color = the even checks'; a.xyz = the odd ones'; b.xy = 1 / the size of a check.
#ifndef CHECKER_GLSL
#define CHECKER_GLSL
#include "records.h"
#include "textures/place.glsl"

SHADER_BEGIN

vec3 checker_color(Texture texture, TextureContext place) {
  // The parity is taken in floats, where an int could overflow.
  float check = floor(place.uv.x * texture.b.x) + floor(place.uv.y * texture.b.y);
  bool odd = check - 2.0f * floor(0.5f * check) != 0.0f;
  return odd ? vec3(texture.a) : texture.color;
}

float checker_alpha(Texture texture, TextureContext place) { return checker_color(texture, place).x; }

SHADER_END
#endif
