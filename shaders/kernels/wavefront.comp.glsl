// Entry: shades one bounce of the paths of a tile, all at the same depth. Without LISTED it takes every pixel, at its camera ray's hit;
// with it the pixels of a list, whose paths go on, so that no lane is idle. With STORED_HITS other kernels have already traced the paths'
// hits, and the losses of their shadow rays; else it traces them itself, each on its lane. Each pixel adds its path's gain, and enters
// itself in the next list if the path goes on. The order of a list changes nothing. With ENDS_ONLY nothing is kept of paths that go on:
// render.comp.glsl restarts those, if rays split in two.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_OUTPUT) restrict buffer Results { SampleResult results[]; };
layout(std430, binding = BINDING_PATHS) restrict buffer Paths { PathState paths[]; };
// The number of paths that go on, then the indices of their pixels in the tile.
layout(std430, binding = BINDING_LIST) readonly restrict buffer List { uint list[]; };
layout(std430, binding = BINDING_NEXT_LIST) restrict buffer NextList { uint next_list[]; };
#define QUEUES_PATHS
#include "kernels/queued_path.glsl"

void main() {
  Frame frame = load_frame();
  uint group = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  uint trail = 1u;
#if RAY_KINDS
  uvec3 kinds = uvec3(0u, 0u, 0u);
#endif
#ifdef LISTED
  uint i = group * 64u + gl_LocalInvocationIndex;
  if (i >= list[0]) return;
  uint slot = list[1u + i];
  Path path = queued_path(slot);
  color = results[slot].color;
  counts = counts_of(results[slot]);
  trail = results[slot].trail;
#if RAY_KINDS
  kinds = uvec3(reflected_of(results[slot]), refracted_of(results[slot]), total_reflections_of(results[slot]));
  counts.z = flags_of(results[slot]);
#endif
#else
  uvec2 pixel = pixel_of_block(group, gl_LocalInvocationIndex, dispatch.tile_width);
  if (pixel.x >= dispatch.tile_width || pixel.y >= dispatch.tile_height) return;
  uint slot = pixel.y * dispatch.tile_width + pixel.x;
  uint x = dispatch.tile_x + pixel.x * dispatch.stride;
  uint y = dispatch.tile_y + pixel.y * dispatch.stride;
  Ray first;
  if (!camera_ray(frame, x, y, dispatch.sample_index, first)) {
    results[slot] = sample_result(color, counts, trail);
    return;
  }
  Path path = begin(frame, first, y * frame.width + x, dispatch.sample_index);
#endif

  Ray ray = path_ray(frame, path);
#if STORED_HITS
  stored_slot = slot;
  Hit hit = hit_of_packet(load_packet_hit(), counts);
#else
  Hit hit = trace(ray, counts.z);
#endif
  Continuations all = shade(frame, path, ray, hit, color, counts, trail);
  counts.z = counts.z | loops_cut_off(LOOP_PROBE);
#if RAY_KINDS
  // Continuing the path is counted here; its way to this hit was counted before.
  bool goes_on = all.count > 0u;
  bool refracted = goes_on && all.next.refracted;
  counts = counts_by_kind(counts, kinds.x + (goes_on && !refracted ? 1u : 0u), kinds.y + (refracted ? 1u : 0u),
                          kinds.z + (all.total_reflection ? 1u : 0u));
#endif

#ifdef ENDS_ONLY
  if (all.count > 0u) {
    next_list[1u + atomicAdd(next_list[0], 1u)] = slot;
    return;
  }
#endif
  results[slot] = sample_result(positive_zeros(color), counts, trail);
#ifndef ENDS_ONLY
  if (all.count > 0u) {
    queue_path(slot, all.next);
    next_list[1u + atomicAdd(next_list[0], 1u)] = slot;
  }
#endif
}
