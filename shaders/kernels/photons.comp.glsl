// Entry: photons of a sample, each on its lane, from the first of the dispatch on.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"

// Stores photons in any order: their numbers identify them when they are sorted.
void store_photon(Photon photon) {
  uint at = atomicAdd(next_list[0], 1u);
  if (at < photon_pass.capacity) photons[at] = photon;
}

#include "integrators/integrator.glsl"
#include "integrators/photon.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { PhotonResult results[]; };

void main() {
  uint i = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE) * 64u + gl_LocalInvocationIndex;
  if (i >= dispatch.count) return;
  results[dispatch.tile_x + i] = photon_way(load_frame(), dispatch.sample_index, dispatch.tile_x + i);
}
