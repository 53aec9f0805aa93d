// Entry for tests: rays from a buffer → trace → hits.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "scene.glsl"
#include "traverse.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = BINDING_RAYS) readonly restrict buffer Rays { QueryRay rays[]; };
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { QueryHit results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= dispatch.tile.x) return;
  Ray ray = make_ray(vec3(rays[i].origin), vec3(rays[i].direction));
  Hit hit = trace(ray);
  results[i].hit = uvec4(floatBitsToUint(hit.t), hit.primitive, occlusion(ray, rays[i].direction.w), 0u);
}
