// Entry: one step of the paths of a tile, all at the same depth. The first wave takes every pixel, and what kernels/cooperative/packet.comp.glsl found for it
// (STORED_HITS); a later one the list of pixels whose paths go on, so that no lane is idle. Each adds what its ray sees and enters itself
// in the next list if its path goes on. The order of a list changes nothing. With ENDS_ONLY the first wave keeps nothing of paths
// that go on: kernels/render.comp.glsl starts them anew, where rays split in two.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_OUTPUT) restrict buffer Results { SampleResult results[]; };
layout(std430, binding = BINDING_PATHS) restrict buffer Paths { PathState paths[]; };
// How many go on, then the places of their pixels in the tile.
layout(std430, binding = BINDING_LIST) readonly restrict buffer List { uint list[]; };
layout(std430, binding = BINDING_NEXT_LIST) restrict buffer NextList { uint next_list[]; };

void main() {
  Frame frame = load_frame();
  uint group = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  PathRay path;
#if STORED_HITS
  uvec2 pixel = pixel_of_block(group, gl_LocalInvocationIndex, dispatch.tile);
  if (pixel.x >= dispatch.tile.z || pixel.y >= dispatch.tile.w) return;
  uint place = pixel.y * dispatch.tile.z + pixel.x;
  path = eye_path(frame, camera_ray(frame, sample_position(frame, dispatch.tile.x + pixel.x, dispatch.tile.y + pixel.y,
                                                        dispatch.sample_index.x)));
#else
  uint i = group * 64u + gl_LocalInvocationIndex;
  if (i >= list[0]) return;
  uint place = list[1u + i];
  path.o = vec3(paths[place].origin);
  path.d = vec3(paths[place].direction);
  path.throughput = vec3(paths[place].throughput);
  path.depth = dispatch.sample_index.y;
  path.media = 0u;
  color = vec3(results[place].color);
  counts = results[place].counts;
#endif

  Ray ray = make_ray(path.o, path.d);
#if STORED_HITS
  stored_place = place;
  Hit hit = hit_of_packet(load_packet_hit(), counts);
#else
  Hit hit = trace(ray, counts.z);
#endif
  Children children = follow(frame, path, ray, hit, color, counts);
  counts.z = counts.z | loops_cut_off(LOOP_PROBE);
#if RAY_KINDS
  // A wave is one reflection of a path that never splits, or all of one that ends at once.
  counts = counts_by_kind(counts, path.depth, 0u, children.totally ? 1u : 0u);
#endif

#ifdef ENDS_ONLY
  if (children.reflects || children.transmits) {
    next_list[1u + atomicAdd(next_list[0], 1u)] = place;
    return;
  }
#endif
  results[place].color = vec4(positive_zeros(color), 1.0f);
  results[place].counts = counts;
#ifndef ENDS_ONLY
  if (children.reflects) {
    paths[place].origin = vec4(children.reflected.o, 0.0f);
    paths[place].direction = vec4(children.reflected.d, 0.0f);
    paths[place].throughput = vec4(children.reflected.throughput, 0.0f);
    next_list[1u + atomicAdd(next_list[0], 1u)] = place;
  }
#endif
}
