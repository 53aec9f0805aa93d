// Rings around z that turbulence bends. Parameters: octaves, how much they bend.
#ifndef TEXTURES_WOOD_GLSL
#define TEXTURES_WOOD_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float wood_share(Texture texture, vec3 p) {
  vec4 bent = pattern_parameters(texture);
  return triangle_wave(sqrt(p.x * p.x + p.y * p.y) + bent.y * turbulence(p, bent.x));
}

vec3 wood_color(Texture texture, TextureContext point) {
  return pattern_color(texture, wood_share(texture, pattern_point(texture, point.p)));
}
float wood_alpha(Texture texture, TextureContext point) { return wood_color(texture, point).x; }

SHADER_END
#endif
