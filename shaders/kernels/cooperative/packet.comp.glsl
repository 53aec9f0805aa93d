// Entry: coherent rays (kernels/cooperative/packet.glsl).
//   PACKET_PRIMARY   the rays of a tile's pixels → PacketHit
//   PACKET_SHADOW    from those hits to every light → occlusion
//   otherwise rays from a buffer → QueryHit, with QUERY_ANY whether there is one
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "scene.glsl"
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"
#include "kernels/eye_path.glsl"

#if defined(PACKET_SHADOW) || defined(QUERY_ANY)
#define ANY true
#else
#define ANY false
#endif
#include "kernels/cooperative/packet.glsl"

layout(local_size_x = 64) in;
#if defined(PACKET_PRIMARY) || defined(PACKET_SHADOW)
layout(std430, binding = BINDING_PACKET_HITS) restrict buffer PacketHits { PacketHit hits[]; };
layout(std430, binding = BINDING_OCCLUSIONS) writeonly restrict buffer Occlusions { uint occlusions[]; };
#else
layout(std430, binding = BINDING_RAYS) readonly restrict buffer Rays { QueryRay rays[]; };
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { QueryHit results[]; };
#endif

// The ray of the packet that is a lane's k-th. Blocks of pixels come in rows of 8: neighbours go to different lanes, 4 × 2 of them, so
// that a triangle that few rays pass is one lane's only once.
uint ray_of(uint lane, uint k) {
#if SUBGROUP_SIZE == 8
  return (lane & 3u) | ((k & 1u) << 2u) | ((lane & 4u) << 1u) | ((k >> 1u) << 4u);
#else
  return k * LANES + lane;
#endif
}

// The index of the result of ray i of a packet; NONE if there is no such ray.
uint slot_of(uint packet, uint i) {
  uint j = packet * uint(PACKET) + i;
#if defined(PACKET_PRIMARY) || defined(PACKET_SHADOW)
  uvec2 pixel = pixel_of_block(j / 64u, j % 64u, dispatch.tile_width);
  bool there = pixel.x < dispatch.tile_width && pixel.y < dispatch.tile_height;
  return there ? pixel.y * dispatch.tile_width + pixel.x : NONE;
#else
  return j < dispatch.count ? j : NONE;
#endif
}

#ifdef PACKET_SHADOW
// The interaction at the hit of the camera ray at `slot`; on_surface: whether it hits anything.
Interaction interaction_of(uint slot, out bool on_surface) {
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  // A lane without a ray reads no other ray's hit, which that ray's lane may be about to change.
  Hit hit = traversal_state(T_MISS).hit;
  if (slot != NONE) hit = hit_of_packet(hits[slot], counts);
  Path path = eye_path(slot == NONE ? 0u : slot);
  return vertex_at(load_frame(), path, make_ray(path.o, path.d), hit, slot != NONE, on_surface);
}
#endif

void main() {
  uint group = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
  uint packet = group * (64u / LANES) + gl_SubgroupID;
  uint lane = gl_SubgroupInvocationID;
  uint slot[RAYS_A_LANE];
  EACH slot[k] = slot_of(packet, ray_of(lane, uint(k)));

#ifdef PACKET_SHADOW
  Frame frame = load_frame();
  Interaction at_hit[RAYS_A_LANE];
  bool on_surface[RAYS_A_LANE];
  uint flags[RAYS_A_LANE];
  EACH flags[k] = 0u;
  EACH at_hit[k] = interaction_of(slot[k], on_surface[k]);
  uint light = 0u;
  do {
    // A ray that need not be traced hits nothing, but must be valid.
    EACH {
      Ray to_light;
      float distance;
      vec3 contribution;
      uint number;
      bool counts = shadow_ray(frame, eye_path(slot[k] == NONE ? 0u : slot[k]), at_hit[k], light, to_light, distance, contribution, number) && on_surface[k];
      ray[k] = make_ray(vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f));
      if (counts) ray[k] = to_light;
      state[k] = traversal_state(counts ? distance : -1.0f);
      intersect_linear_list(state[k], ray[k], true);
    }
    traverse_together(lane);
    EACH {
      flags[k] = flags[k] | iteration_limit(state[k]);
      if (slot[k] != NONE) occlusions[light * dispatch.count + slot[k]] = state[k].occluded;
    }
    light += 1u;
  } while (light < shadow_rays());
  uint cut_off = loops_cut_off(LOOP_PROBE);
  EACH {
    if (slot[k] != NONE) hits[slot[k]].flags = hits[slot[k]].flags | flags[k] | cut_off;
  }
#else
  EACH {
#ifdef PACKET_PRIMARY
    ray[k] = path_ray(load_frame(), eye_path(slot[k] == NONE ? 0u : slot[k]));
    state[k] = traversal_state(slot[k] == NONE ? -1.0f : T_MISS);
#else
    QueryRay requested = rays[slot[k] == NONE ? 0u : slot[k]];
    ray[k] = make_ray(requested.origin, requested.direction);
    state[k] = traversal_state(slot[k] == NONE ? -1.0f : minimum(requested.t_max, T_MISS));
#endif
    intersect_linear_list(state[k], ray[k], ANY);
  }
  traverse_together(lane);
  uint flags = loops_cut_off(LOOP_PROBE);
  EACH {
    if (slot[k] != NONE) {
#ifdef PACKET_PRIMARY
      hits[slot[k]] = packet_of_hit(state[k].hit, flags | iteration_limit(state[k]));
#else
      results[slot[k]] = answer(state[k], ANY, flags);
#endif
    }
  }
#endif
}
