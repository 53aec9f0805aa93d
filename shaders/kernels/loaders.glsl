// Functions by which all other code reads the scene from the buffers. Small parts are compiled in instead
// (executors/specialise.cpp).
#ifndef LOADERS_GLSL
#define LOADERS_GLSL
#include "kernels/bindings.glsl"

#ifndef SCENE_PRIMITIVES
#if TEXEL_BUFFERS
uvec4 load_vertex(uint i) { return imageLoad(vertices, int(i)); }
uvec4 load_node(uint i) { return imageLoad(nodes, int(i)); }
Primitive load_primitive(uint i) {
  int at = int(4u * i);
  return primitive_of(imageLoad(primitives, at), uintBitsToFloat(imageLoad(primitives, at + 1)),
                      uintBitsToFloat(imageLoad(primitives, at + 2)), uintBitsToFloat(imageLoad(primitives, at + 3)));
}
#else
uvec4 load_vertex(uint i) { return vertices[i]; }
uvec4 load_node(uint i) { return nodes[i]; }
Primitive load_primitive(uint i) { return primitives[i]; }
#endif
#endif
#ifndef FRAME_AS_CONSTANT
#if TEXEL_BUFFERS
Frame load_frame() {
  uvec4 image = imageLoad(frame_words, 0);
  uvec4 camera = imageLoad(frame_words, 1);
  uvec4 counts = imageLoad(frame_words, 2);
  vec4 right = uintBitsToFloat(imageLoad(frame_words, 3));
  vec4 up = uintBitsToFloat(imageLoad(frame_words, 4));
  vec4 forward = uintBitsToFloat(imageLoad(frame_words, 5));
  vec4 background = uintBitsToFloat(imageLoad(frame_words, 6));
  vec4 ambient = uintBitsToFloat(imageLoad(frame_words, 7));
  uvec4 lens = imageLoad(frame_words, 8);
  uvec4 around = imageLoad(frame_words, 9);
  uvec4 pixel = imageLoad(frame_words, 10);
  vec4 medium_min = uintBitsToFloat(imageLoad(frame_words, 11));
  vec4 medium_max = uintBitsToFloat(imageLoad(frame_words, 12));
  return Frame(image.x, image.y, image.z, image.w, camera.x, camera.y, camera.z, camera.w, counts.x, counts.y, counts.z, counts.w,
               vec3(right), right.w, vec3(up), up.w, vec3(forward), forward.w, vec3(background), floatBitsToUint(background.w), vec3(ambient), ambient.w,
               uintBitsToFloat(lens.x), uintBitsToFloat(lens.y), lens.z, lens.w, around.x, around.y,
               around.z, uintBitsToFloat(around.w), uintBitsToFloat(pixel.x), pixel.y, pixel.z, pixel.w,
               vec3(medium_min), medium_min.w, vec3(medium_max), medium_max.w);
}
#else
Frame load_frame() { return frame_record; }
#endif
#endif
#if STORED_HITS
uint stored_slot;  // index of this invocation's pixel in the results
PacketHit load_packet_hit() { return packet_hits[stored_slot]; }
uint load_occlusion(uint light) { return occlusions[light * dispatch.count + stored_slot]; }
#endif
#if HAS_LIGHT_BVH
LightNode load_light_node(uint i) { return light_nodes[i]; }
#endif
#if HAS_PHOTONS
PhotonPass load_photon_pass() { return photon_pass; }
vec4 load_photon_target(uint i) { return photon_pass.targets[i]; }
uint load_emitter_media(uint i) { return emitter_media[i]; }
#ifndef SENDS_PHOTONS
Photon load_photon(uint i) { return photons[i]; }
uint load_photon_cell(uint key) { return photon_cells[key]; }
#endif
#endif
#if RANDOM_WALK
vec4 load_albedo(uint i) { return albedos[i]; }
#endif
Bvh load_bvh(uint i) { return bvhs[i]; }
Instance load_instance(uint i) { return instances[i]; }
// Vertices that a loop looks up: a choice among constants would be made anew in each iteration.
#if TEXEL_BUFFERS
uvec4 load_outline(uint i) { return imageLoad(vertices, int(i)); }
uvec4 load_environment(uint i) { return imageLoad(environment, int(i)); }
uint load_texel(uint i) {
  uvec4 four = imageLoad(texels, int(i >> 2u));
  uint which = i & 3u;
  return which == 0u ? four.x : which == 1u ? four.y : which == 2u ? four.z : four.w;
}
#else
uvec4 load_outline(uint i) { return vertices[i]; }
uvec4 load_environment(uint i) { return environment[i]; }
uint load_texel(uint i) { return texels[i]; }
#endif
#ifndef SHADING_AS_CONSTANTS
Material load_material(uint i) { return materials[i]; }
Texture load_texture(uint i) { return textures[i]; }
Medium load_medium(uint i) { return media[i]; }
Light load_light(uint i) { return lights[i]; }
Emitter load_emitter(uint i) { return emitters[i]; }
#endif

#endif
