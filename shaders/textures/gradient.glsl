// A ramp along x, again and again.
#ifndef TEXTURES_GRADIENT_GLSL
#define TEXTURES_GRADIENT_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float gradient_share(Texture texture, vec3 p) {
  return fraction(p.x);
}

vec3 gradient_color(Texture texture, TextureContext point) {
  return pattern_color(texture, gradient_share(texture, pattern_point(texture, point.p)));
}
float gradient_alpha(Texture texture, TextureContext point) { return gradient_color(texture, point).x; }

SHADER_END
#endif
