// From a texture and a point on a surface to its colour, or its alpha: calls the kind, of those that materials have in that slot.
#ifndef TEXTURE_GLSL
#define TEXTURE_GLSL
#include "materials/rows.h"
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

#define COLOR_OF(name, number, varies) \
  if (texture.kind == number) color = name##_color(texture, point);
#define TEXTURE_OF(slot)                              \
  vec3 slot##_texture(uint index, TextureContext point) { \
    Texture texture = load_texture(index);            \
    vec3 color = vec3(0.0f, 0.0f, 0.0f);              \
    TEXTURES_OF(slot, COLOR_OF)                       \
    return color;                                     \
  }                                                   \
  vec3 slot##_of(Material material, TextureContext point) { return slot##_texture(material.slot, point); }
MATERIAL_TEXTURES(TEXTURE_OF)

#if HAS_ALPHA_TEST
float alpha_at(Material material, TextureContext point) {
  Texture texture = load_texture(material.alpha);
  float alpha = 0.0f;
#define ALPHA_OF(name, number, varies) \
  if (texture.kind == number) alpha = name##_alpha(texture, point);
  TEXTURES_OF(alpha, ALPHA_OF)
  return alpha;
}
#endif

SHADER_END
#endif
