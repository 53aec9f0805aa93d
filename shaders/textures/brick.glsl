// Bricks in mortar, each layer set off by half a brick. Parameters: the size of a brick with its mortar, the mortar's width.
#ifndef TEXTURES_BRICK_GLSL
#define TEXTURES_BRICK_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float brick_share(Texture texture, vec3 p) {
  vec4 brick = pattern_parameters(texture);
  float layer = floor(p.y / brick.y);
  float off = layer - 2.0f * floor(0.5f * layer) != 0.0f ? 0.5f : 0.0f;
  float x = fraction(p.x / brick.x + off) * brick.x;
  float y = (p.y / brick.y - layer) * brick.y;
  float z = fraction(p.z / brick.z + off) * brick.z;
  return minimum(x, minimum(y, z)) < brick.w ? 0.0f : 1.0f;
}

vec3 brick_color(Texture texture, TextureContext point) {
  return pattern_color(texture, brick_share(texture, pattern_point(texture, point.p)));
}
float brick_alpha(Texture texture, TextureContext point) { return brick_color(texture, point).x; }

SHADER_END
#endif
