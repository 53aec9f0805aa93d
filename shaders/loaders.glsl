// How everything else reads the scene, when it is in the buffers; a small scene is compiled in instead (render/specialise.cpp).
#ifndef LOADERS_GLSL
#define LOADERS_GLSL
#include "bindings.glsl"

Primitive load_primitive(uint i) { return primitives[i]; }
vec4 load_vertex(uint i) { return vertices[i]; }
Material load_material(uint i) { return materials[i]; }
Texture load_texture(uint i) { return textures[i]; }
uint load_texel(uint i) { return texels[i]; }
Medium load_medium(uint i) { return media[i]; }
Light load_light(uint i) { return lights[i]; }

#endif
