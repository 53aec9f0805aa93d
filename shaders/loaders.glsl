// How everything else reads the scene, when it is in the buffers; a small scene is compiled in instead (render/specialise.cpp).
#ifndef LOADERS_GLSL
#define LOADERS_GLSL
#include "bindings.glsl"

#if TEXEL_BUFFERS
uvec4 load_vertex(uint i) { return imageLoad(vertices, int(i)); }
uvec4 load_outline(uint i) { return load_vertex(i); }
uvec4 load_node(uint i) { return imageLoad(nodes, int(i)); }
uvec4 load_primitive_word(uint i) { return imageLoad(primitives, int(i)); }
Primitive load_primitive(uint i) {
  Primitive p;
  p.head = load_primitive_word(4u * i);
  p.a = uintBitsToFloat(load_primitive_word(4u * i + 1u));
  p.b = uintBitsToFloat(load_primitive_word(4u * i + 2u));
  p.c = uintBitsToFloat(load_primitive_word(4u * i + 3u));
  return p;
}
#else
uvec4 load_vertex(uint i) { return vertices[i]; }
uvec4 load_outline(uint i) { return load_vertex(i); }
uvec4 load_node(uint i) { return nodes[i]; }
Primitive load_primitive(uint i) { return primitives[i]; }
uvec4 load_primitive_word(uint i) {
  uint which = i & 3u;
  return which == 0u   ? primitives[i >> 2u].head
         : which == 1u ? floatBitsToUint(primitives[i >> 2u].a)
         : which == 2u ? floatBitsToUint(primitives[i >> 2u].b)
                       : floatBitsToUint(primitives[i >> 2u].c);
}
#endif
#if STORED_HITS
uint stored_place;  // of this invocation's pixel
PacketHit load_packet_hit() { return packet_hits[stored_place]; }
uint load_occlusion(uint light) { return occlusions[light * dispatch.sample_index.z + stored_place]; }
#endif
Tree load_tree(uint i) { return trees[i]; }
Instance load_instance(uint i) { return instances[i]; }
Material load_material(uint i) { return materials[i]; }
Texture load_texture(uint i) { return textures[i]; }
uint load_texel(uint i) { return texels[i]; }
Medium load_medium(uint i) { return media[i]; }
Light load_light(uint i) { return lights[i]; }

#endif
