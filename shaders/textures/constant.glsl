// One colour.
#ifndef CONSTANT_GLSL
#define CONSTANT_GLSL
#include "records.h"

SHADER_BEGIN

vec3 constant_color(Texture texture, vec2 uv) { return texture.color; }

float constant_alpha(Texture texture, vec2 uv) { return texture.color.x; }

SHADER_END
#endif
