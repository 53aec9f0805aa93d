// What the entries share: the buffers.
#ifndef BINDINGS_GLSL
#define BINDINGS_GLSL
#include "records.h"

layout(push_constant) uniform PushConstants { Dispatch dispatch; };
layout(std430, binding = BINDING_PRIMITIVES) readonly restrict buffer Primitives { Primitive primitives[]; };
layout(std430, binding = BINDING_VERTICES) readonly restrict buffer Vertices { vec4 vertices[]; };
layout(std430, binding = BINDING_MATERIALS) readonly restrict buffer Materials { Material materials[]; };
layout(std430, binding = BINDING_TEXTURES) readonly restrict buffer Textures { Texture textures[]; };
layout(std430, binding = BINDING_TEXELS) readonly restrict buffer Texels { uint texels[]; };
layout(std430, binding = BINDING_MEDIA) readonly restrict buffer Media { Medium media[]; };
layout(std430, binding = BINDING_LIGHTS) readonly restrict buffer Lights { Light lights[]; };
layout(std430, binding = BINDING_FRAME) readonly restrict buffer FrameBuffer { Frame frame; };

#endif
