// Entry: a tile of the picture. One sample of each pixel, or with FIRST_HITS what the ray through its centre meets.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"  // made for the scene by render/specialise.cpp: only what it has is compiled
#include "pixel.glsl"

layout(local_size_x = 64) in;
#ifdef FIRST_HITS
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { HitResult results[]; };
#else
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { SampleResult results[]; };
#endif

void main() {
  // Deal the 8 × 8 blocks out over GROUP_STRIDE contiguous runs of workgroups: a CPU driver gives each thread one run, and
  // so each gets a fair share of sky and glass.
  uint run = gl_NumWorkGroups.x / GROUP_STRIDE;
  uint block = (gl_WorkGroupID.x % run) * GROUP_STRIDE + gl_WorkGroupID.x / run;
  uint blocks_across = (dispatch.tile.z + 7u) / 8u;

  // Eight neighbouring invocations cover 4 × 2 pixels.
  uint i = gl_LocalInvocationIndex;
  uint x = (block % blocks_across) * 8u + ((i & 3u) | ((i & 8u) >> 1u));
  uint y = (block / blocks_across) * 8u + (((i & 4u) >> 2u) | ((i & 48u) >> 3u));
  if (x >= dispatch.tile.z || y >= dispatch.tile.w) return;

#ifdef FIRST_HITS
  results[y * dispatch.tile.z + x] = first_hit(frame, dispatch.tile.x + x, dispatch.tile.y + y);
#else
  results[y * dispatch.tile.z + x] =
      render_sample(frame, dispatch.tile.x + x, dispatch.tile.y + y, dispatch.sample_index.x);
#endif
}
