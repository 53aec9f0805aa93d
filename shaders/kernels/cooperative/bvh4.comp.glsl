// Entry: incoherent rays, four lanes a ray (kernels/cooperative/bvh4.glsl).
//   BOUNCE_HITS      the rays of the paths in a list → PacketHit
//   BOUNCE_SHADOW    from those hits to every light → occlusion
//   otherwise rays from a buffer → QueryHit, with QUERY_ANY whether there is one
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "scene.glsl"
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"

#if defined(QUERY_ANY) || defined(BOUNCE_SHADOW)
#define ANY true
#else
#define ANY false
#endif
#if TEXEL_BUFFERS
layout(rgba32ui, binding = BINDING_BVH4_NODES) readonly restrict uniform uimageBuffer bvh4_nodes;
uvec4 load_bvh4_child(uint i) { return imageLoad(bvh4_nodes, int(i)); }
#else
layout(std430, binding = BINDING_BVH4_NODES) readonly restrict buffer Bvh4Nodes { uvec4 bvh4_nodes[]; };
uvec4 load_bvh4_child(uint i) { return bvh4_nodes[i]; }
#endif
#include "kernels/cooperative/bvh4.glsl"

layout(local_size_x = 64) in;
#if defined(BOUNCE_HITS) || defined(BOUNCE_SHADOW)
layout(std430, binding = BINDING_PATHS) readonly restrict buffer Paths { PathState paths[]; };
layout(std430, binding = BINDING_LIST) readonly restrict buffer List { uint list[]; };
layout(std430, binding = BINDING_PACKET_HITS) restrict buffer PacketHits { PacketHit hits[]; };
layout(std430, binding = BINDING_OCCLUSIONS) writeonly restrict buffer Occlusions { uint occlusions[]; };
#include "kernels/queued_path.glsl"
#else
layout(std430, binding = BINDING_RAYS) readonly restrict buffer Rays { QueryRay rays[]; };
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { QueryHit results[]; };
#endif

void main() {
  uint i = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE) * 64u + gl_LocalInvocationIndex;
  find_group(gl_SubgroupInvocationID);
#if defined(BOUNCE_HITS) || defined(BOUNCE_SHADOW)
  bool there = i < list[0];
  uint slot = list[1u + (there ? i : 0u)];
  Path path = queued_path(slot);
  Frame frame = load_frame();
  Ray bounced = path_ray(frame, path);
#ifdef BOUNCE_HITS
  TraversalState found = trace_cooperatively(bounced, there ? T_MISS : -1.0f);
  if (there) hits[slot] = packet_of_hit(found.hit, loops_cut_off(LOOP_PROBE) | iteration_limit(found));
#else
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  // A lane without a path reads no other path's hit, which that path's lane may be about to change.
  Hit hit = traversal_state(T_MISS).hit;
  if (there) hit = hit_of_packet(hits[slot], counts);
  bool on_surface;
  Interaction at_hit = vertex_at(frame, path, bounced, hit, there, on_surface);
  uint flags = 0u;
  uint light = 0u;
  do {
    Ray to_light;
    float distance;
    vec3 contribution;
    uint number;
    bool requested = shadow_ray(frame, path, at_hit, light, to_light, distance, contribution, number) && on_surface;
    if (!requested) to_light = make_ray(vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f));
    TraversalState found = trace_cooperatively(to_light, requested ? distance : -1.0f);
    flags = flags | iteration_limit(found);
    if (there) occlusions[light * dispatch.count + slot] = found.occluded;
    light += 1u;
  } while (light < shadow_rays());
  flags = flags | loops_cut_off(LOOP_PROBE);
  if (there) hits[slot].flags = hits[slot].flags | flags;
#endif
#else
  bool there = i < dispatch.count;
  QueryRay requested = rays[there ? i : 0u];
  Ray own = make_ray(requested.origin, requested.direction);
  TraversalState found = trace_cooperatively(own, there ? minimum(requested.t_max, T_MISS) : -1.0f);
  if (there) results[i] = answer(found, ANY, loops_cut_off(LOOP_PROBE));
#endif
}
