// Layers along x that turbulence bends. Parameters: octaves, how much they bend.
#ifndef TEXTURES_MARBLE_GLSL
#define TEXTURES_MARBLE_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float marble_share(Texture texture, vec3 p) {
  vec4 bent = pattern_parameters(texture);
  return triangle_wave(p.x + bent.y * turbulence(p, bent.x));
}

vec3 marble_color(Texture texture, TextureContext point) {
  return pattern_color(texture, marble_share(texture, pattern_point(texture, point.p)));
}
float marble_alpha(Texture texture, TextureContext point) { return marble_color(texture, point).x; }

SHADER_END
#endif
