// Entry: a tile of the picture. One sample of each pixel, or with LISTED of those in a list. With FIRST_HITS the hit of the ray through the
// centre of each. With AUXILIARY the values that a denoiser needs of the sample.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "scene.glsl"  // made for the scene by executors/specialise.cpp: only its features are compiled
#include "kernels/pixel.glsl"
#include "kernels/tile.glsl"

layout(local_size_x = 64) in;
#ifdef FIRST_HITS
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { HitResult results[]; };
#elif defined(AUXILIARY)
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { AuxiliaryResult results[]; };
#else
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { SampleResult results[]; };
#endif

#ifdef LISTED
// The number of pixels, then their indices in the tile.
layout(std430, binding = BINDING_LIST) readonly restrict buffer List { uint list[]; };
#endif

void main() {
  uint group = swizzled_workgroup(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
#ifdef LISTED
  uint entry = group * 64u + gl_LocalInvocationIndex;
  if (entry >= list[0]) return;
  uint i = list[1u + entry];
  uint row = quotient(i, dispatch.tile_width);
  uvec2 pixel = uvec2(i - row * dispatch.tile_width, row);
#else
  uvec2 pixel = pixel_of_block(group, gl_LocalInvocationIndex, dispatch.tile_width);
  if (pixel.x >= dispatch.tile_width || pixel.y >= dispatch.tile_height) return;
  uint i = pixel.y * dispatch.tile_width + pixel.x;
#endif
  uint x = dispatch.tile_x + pixel.x * dispatch.stride;
  uint y = dispatch.tile_y + pixel.y * dispatch.stride;
  Frame frame = load_frame();

#ifdef FIRST_HITS
  results[i] = first_hit(frame, x, y);
#elif defined(AUXILIARY)
  results[i] = render_auxiliary(frame, x, y, dispatch.sample_index);
#else
  results[i] = render_sample(frame, x, y, dispatch.sample_index);
#endif
}
