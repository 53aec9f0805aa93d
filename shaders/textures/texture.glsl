// From a texture and a place on a surface to its colour, or its alpha: asks the kind of texture.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "records.h"
#include "textures/place.glsl"

SHADER_BEGIN

vec3 texture_color(uint index, TextureContext place) {
  Texture texture = load_texture(index);
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
#define COLOR_OF(name, number, varies) \
  if (texture.kind == number) color = name##_color(texture, place);
  TEXTURES(COLOR_OF)
  return color;
}

#if HAS_ALPHA_TEST
float texture_alpha(uint index, TextureContext place) {
  Texture texture = load_texture(index);
  float alpha = 0.0f;
#define ALPHA_OF(name, number, varies) \
  if (texture.kind == number) alpha = name##_alpha(texture, place);
  TEXTURES(ALPHA_OF)
  return alpha;
}
#endif

SHADER_END
#endif
