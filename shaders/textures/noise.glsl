// Clouds. Parameters: octaves.
#ifndef TEXTURES_NOISE_GLSL
#define TEXTURES_NOISE_GLSL
#include "textures/pattern.glsl"

SHADER_BEGIN

float noise_share(Texture texture, vec3 p) {
  float value = 0.5f + 0.5f * turbulence(p, pattern_parameters(texture).x);
  return minimum(maximum(value, 0.0f), 1.0f);
}

vec3 noise_color(Texture texture, TextureContext point) {
  return pattern_color(texture, noise_share(texture, pattern_point(texture, point.p)));
}
float noise_alpha(Texture texture, TextureContext point) { return noise_color(texture, point).x; }

SHADER_END
#endif
