// What the entries do for one pixel: pixel → ray → colour, and pixel → ray → first hit.
#ifndef PIXEL_GLSL
#define PIXEL_GLSL
#include "cameras/camera.glsl"
#include "kernels/loops.glsl"
#include "geometry/surface.glsl"
#include "bvh/traverse.glsl"
#include "integrators/loop.glsl"

SHADER_BEGIN

SampleResult render_sample(Frame frame, uint x, uint y, uint index) {
  Ray ray = camera_ray(frame, sample_position(frame, x, y, index));
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  vec3 color = radiance(frame, ray, counts);
  counts.z = counts.z | loops_cut_off(LOOP_PROBE);
  SampleResult result;
  result.color = vec4(positive_zeros(color), 1.0f);
  result.counts = counts;
  return result;
}

HitResult first_hit(Frame frame, uint x, uint y) {
  Ray ray = camera_ray(frame, vec2(float(x) + 0.5f, float(y) + 0.5f));
  uint flags = 0u;
  Hit hit = trace(ray, flags);
  flags = flags | loops_cut_off(LOOP_PROBE);
  HitResult result;
  result.position_t = vec4(0.0f, 0.0f, 0.0f, T_MISS);
  result.normal = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  result.uv = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  result.ids = uvec4(NONE, NONE, flags, 0u);
  if (hit.slot != NONE) {
    Primitive primitive = primitive_at(hit);
    Surface surface = surface_at(primitive, ray, hit);
    result.position_t = vec4(positive_zeros(surface.p), hit.t);
    result.normal = vec4(positive_zeros(surface.normal), 0.0f);
    result.uv = vec4(positive_zero(surface.uv.x), positive_zero(surface.uv.y), 0.0f, 0.0f);
    result.ids = uvec4(hit.id, material_of(primitive), flags, 0u);
  }
  return result;
}

QueryHit answer(TraversalState state, bool any, uint flags) {
  bool struck = any ? state.occluded >= OPTICAL_DEPTH_OPAQUE : state.hit.slot != NONE;
  float t = struck ? (any ? 0.0f : state.hit.t) : T_MISS;
  QueryHit result;
  result.hit = uvec4(floatBitsToUint(t), struck && !any ? state.hit.id : NONE, flags | iteration_limit(state), state.occluded);
  return result;
}

// A ray asked about alone: the nearest hit before its t_max, or whether anything keeps its light away.
QueryHit query(QueryRay asked, bool any) {
  Ray ray = make_ray(vec3(asked.origin), vec3(asked.direction));
  TraversalState state = search(ray, minimum(asked.direction.w, T_MISS), any);
  return answer(state, any, loops_cut_off(LOOP_PROBE));
}

SHADER_END
#endif
