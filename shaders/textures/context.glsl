// The point at which a texture is sampled: on the surface, and in space.
#ifndef TEXTURES_CONTEXT_GLSL
#define TEXTURES_CONTEXT_GLSL
#include "language.h"

SHADER_BEGIN

struct TextureContext {
  vec2 uv;
#if HAS_SECOND_UV
  vec2 second_uv;  // second uv of a mesh's vertices; uv where there are none
#endif
  vec3 p;  // from the eye
};

// For callers that sample no pattern in space.
TextureContext context_of_uv(vec2 uv) {
  TextureContext point;
  point.uv = uv;
#if HAS_SECOND_UV
  point.second_uv = uv;
#endif
  point.p = vec3(0.0f, 0.0f, 0.0f);
  return point;
}

SHADER_END
#endif
