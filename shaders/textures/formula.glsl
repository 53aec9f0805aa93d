// A function of the scene's. color: a factor of its result.
#ifndef TEXTURES_FORMULA_GLSL
#define TEXTURES_FORMULA_GLSL
#include "math/math.glsl"
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

uint texture_formula(Texture texture) { return texture.c.x; }  // its number among the scene's

// A formula may return anything: a NaN becomes 0.
float formula_share(float x) { return x > 0.0f ? minimum(x, 1.0f) : 0.0f; }

vec3 formula_color(Texture texture, TextureContext point) {
  vec3 color = FORMULA_COLOR(texture_formula(texture), point.uv);
  return texture.color * vec3(formula_share(color.x), formula_share(color.y), formula_share(color.z));
}

float formula_alpha(Texture texture, TextureContext point) { return formula_color(texture, point).x; }

SHADER_END
#endif
