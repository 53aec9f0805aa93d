// Cubes of side 1, each of the other colour than its neighbours.
#ifndef TEXTURES_SOLID_CHECKER_GLSL
#define TEXTURES_SOLID_CHECKER_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float solid_checker_share(Texture texture, vec3 p) {
  float check = floor(p.x) + floor(p.y) + floor(p.z);
  return check - 2.0f * floor(0.5f * check) != 0.0f ? 1.0f : 0.0f;
}

vec3 solid_checker_color(Texture texture, TextureContext point) {
  return pattern_color(texture, solid_checker_share(texture, pattern_point(texture, point.p)));
}
float solid_checker_alpha(Texture texture, TextureContext point) { return solid_checker_color(texture, point).x; }

SHADER_END
#endif
