// How everything else reads the scene, when it is in the buffers; what is small is compiled in instead (executors/specialise.cpp).
#ifndef LOADERS_GLSL
#define LOADERS_GLSL
#include "kernels/bindings.glsl"

#ifndef SCENE_PRIMITIVES
#if TEXEL_BUFFERS
uvec4 load_vertex(uint i) { return imageLoad(vertices, int(i)); }
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
#endif
#ifndef FRAME_AS_CONSTANT
#if TEXEL_BUFFERS
Frame load_frame() {
  Frame f;
  f.image = imageLoad(frame_words, 0);
  f.camera = imageLoad(frame_words, 1);
  f.counts = imageLoad(frame_words, 2);
  f.right = uintBitsToFloat(imageLoad(frame_words, 3));
  f.up = uintBitsToFloat(imageLoad(frame_words, 4));
  f.forward = uintBitsToFloat(imageLoad(frame_words, 5));
  f.background = uintBitsToFloat(imageLoad(frame_words, 6));
  f.ambient = uintBitsToFloat(imageLoad(frame_words, 7));
  return f;
}
#else
Frame load_frame() { return frame_record; }
#endif
#endif
#if STORED_HITS
uint stored_place;  // of this invocation's pixel
PacketHit load_packet_hit() { return packet_hits[stored_place]; }
uint load_occlusion(uint light) { return occlusions[light * dispatch.sample_index.z + stored_place]; }
#endif
Bvh load_bvh(uint i) { return bvhs[i]; }
Instance load_instance(uint i) { return instances[i]; }
// Vertices that a loop looks up: a choice among constants would be made anew at each turn.
#if TEXEL_BUFFERS
uvec4 load_outline(uint i) { return imageLoad(vertices, int(i)); }
uint load_texel(uint i) {
  uvec4 four = imageLoad(texels, int(i >> 2u));
  uint which = i & 3u;
  return which == 0u ? four.x : which == 1u ? four.y : which == 2u ? four.z : four.w;
}
#else
uvec4 load_outline(uint i) { return vertices[i]; }
uint load_texel(uint i) { return texels[i]; }
#endif
#ifndef SHADING_AS_CONSTANTS
Material load_material(uint i) { return materials[i]; }
Texture load_texture(uint i) { return textures[i]; }
Medium load_medium(uint i) { return media[i]; }
Light load_light(uint i) { return lights[i]; }
#endif

#endif
