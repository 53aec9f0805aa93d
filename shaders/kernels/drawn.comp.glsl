// Entry: the eye rays of a tile where a rasteriser has drawn what they hit → PacketHit. What was drawn at a pixel its ray tests, and no more.
// A ray that misses it, by the edge of a triangle, enters itself in the next list; with LISTED those of a list are traced.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"
#include "kernels/eye_path.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_PACKET_HITS) writeonly restrict buffer PacketHits { PacketHit hits[]; };
// How many rays, then their places in the tile.
#ifdef LISTED
layout(std430, binding = BINDING_LIST) readonly restrict buffer List { uint list[]; };
#else
layout(std430, binding = BINDING_NEXT_LIST) restrict buffer NextList { uint next_list[]; };
layout(std430, binding = BINDING_DRAWN) readonly restrict buffer Drawn { uint drawn[]; };
#endif

void main() {
  uint group = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
#ifdef LISTED
  uint i = group * 64u + gl_LocalInvocationIndex;
  if (i >= list[0]) return;
  uint place = list[1u + i];
  uint flags = 0u;
  Hit hit = trace(eye_ray_of(place), flags);
  hits[place] = packet_of_hit(hit, flags | loops_cut_off(LOOP_PROBE));
#else
  uvec2 pixel = pixel_of_block(group, gl_LocalInvocationIndex, dispatch.tile_width);
  if (pixel.x >= dispatch.tile_width || pixel.y >= dispatch.tile_height) return;
  uint place = pixel.y * dispatch.tile_width + pixel.x;
  uint what = drawn[(dispatch.tile_y + pixel.y) * load_frame().width + dispatch.tile_x + pixel.x];
  bool is_triangle = what != DRAWN_NOTHING && what != DRAWN_OTHER;
  TraversalState state = traversal_state(T_MISS);
  if (is_triangle) intersect_slot(state, what - 1u, world_ray(eye_ray_of(place)), false);
  if (what == DRAWN_NOTHING || state.hit.slot != NONE) hits[place] = packet_of_hit(state.hit, 0u);
  else next_list[1u + atomicAdd(next_list[0], 1u)] = place;
#endif
}
