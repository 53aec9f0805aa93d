// A checkerboard. color = the even checks'.
#ifndef CHECKER_GLSL
#define CHECKER_GLSL
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

vec3 checker_odd_color(Texture texture) { return vec3(texture.a); }
vec2 checker_checks(Texture texture) { return vec2(texture.b); }  // per unit of u and of v

vec3 checker_color(Texture texture, TextureContext point) {
  vec2 checks = checker_checks(texture);
  // The parity is taken in floats, where an int could overflow.
  float check = floor(point.uv.x * checks.x) + floor(point.uv.y * checks.y);
  bool odd = check - 2.0f * floor(0.5f * check) != 0.0f;
  return odd ? checker_odd_color(texture) : texture.color;
}

float checker_alpha(Texture texture, TextureContext point) { return checker_color(texture, point).x; }

SHADER_END
#endif
