// One colour.
#ifndef CONSTANT_GLSL
#define CONSTANT_GLSL
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

vec3 constant_color(Texture texture, TextureContext point) { return texture.color; }

float constant_alpha(Texture texture, TextureContext point) { return texture.color.x; }

SHADER_END
#endif
