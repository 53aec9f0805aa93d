// Entry: single rays from a buffer. Without QUERY_ANY the nearest hit, with it whether there is one.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_RAYS) readonly restrict buffer Rays { QueryRay rays[]; };
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { QueryHit results[]; };

void main() {
  uint i = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE) * 64u + gl_LocalInvocationIndex;
  if (i >= dispatch.count) return;
#ifdef QUERY_ANY
  results[i] = query(rays[i], true);
#else
  results[i] = query(rays[i], false);
#endif
}
