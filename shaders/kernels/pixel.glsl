// The work of the entries for one pixel: pixel → ray → colour, and pixel → ray → first hit.
#ifndef PIXEL_GLSL
#define PIXEL_GLSL
#include "cameras/camera.glsl"
#include "cameras/lens.glsl"
#include "kernels/loops.glsl"
#include "geometry/surface.glsl"
#include "bvh/traverse.glsl"
#include "integrators/auxiliary.glsl"
#include "integrators/loop.glsl"
#include "samplers/sampler.glsl"

SHADER_BEGIN

// The camera ray of sample `index` of pixel (x, y); false if there is none because the camera sees nothing there.
bool camera_ray(Frame frame, uint x, uint y, uint index, OUT(Ray) ray) {
  vec2 position = sample_position(frame, x, y, index);
  vec2 lens = vec2(0.0f, 0.0f);
#if HAS_LENS
  lens = point_on_lens(frame, sample_pair(frame, y * frame.width + x, index, PAIR_LENS));
#endif
  ray = camera_ray(frame, position, lens);
  return camera_sees(frame, position, lens);
}

SampleResult render_sample(Frame frame, uint x, uint y, uint index) {
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  Ray ray;
  if (!camera_ray(frame, x, y, index, ray)) return sample_result(vec3(0.0f, 0.0f, 0.0f), counts, 1u);
  uint trail = 1u;
  vec3 color = radiance(frame, ray, y * frame.width + x, index, counts, trail);
  PROBE_BACK(NONE);
  counts.z = counts.z | loops_cut_off(LOOP_PROBE);
  return sample_result(positive_zeros(color), counts, trail);
}

AuxiliaryResult render_auxiliary(Frame frame, uint x, uint y, uint index) {
  AuxiliaryResult result = no_auxiliary();
#if RANDOM_WALK
  Ray ray;
  if (camera_ray(frame, x, y, index, ray)) {
    result = auxiliary_of(frame, ray, y * frame.width + x, index);
    result.albedo = positive_zeros(result.albedo);
    result.normal = positive_zeros(result.normal);
  }
  result.flags = result.flags | loops_cut_off(LOOP_PROBE);
#endif
  return result;
}

// Through the middle of the pixel, from that of the lens; of surfaces that blend, it hits those that the pixel's first sample hits.
HitResult first_hit(Frame frame, uint x, uint y) {
  vec2 position = vec2(float(x) + 0.5f, float(y) + 0.5f);
  vec2 lens = vec2(0.0f, 0.0f);
  Ray ray = camera_ray(frame, position, lens);
  ray = with_alpha_key(ray, frame, begin(frame, ray, y * frame.width + x, 0u), 0u);
  uint flags = 0u;
  TraversalState state = search(ray, camera_sees(frame, position, lens) ? T_MISS : -1.0f, false);
  Hit hit = state.hit;
  flags = flags | iteration_limit(state) | loops_cut_off(LOOP_PROBE);
  HitResult result;
  result.position = vec3(0.0f, 0.0f, 0.0f);
  result.t = T_MISS;
  result.normal = vec3(0.0f, 0.0f, 0.0f);
  result.u = 0.0f;
  result.normal_geometric = vec3(0.0f, 0.0f, 0.0f);
  result.v = 0.0f;
  result.cosine = 0.0f;
  result.primitive = NONE;
  result.material = NONE;
  result.flags = flags;
  result.nodes = 0u;
  result.tests = 0u;
  result.unused_0 = 0u;
  result.unused_1 = 0u;
#if SEARCH_COST
  result.nodes = state.nodes;
  result.tests = state.tests;
#endif
  if (hit.slot != NONE) {
    Primitive primitive = primitive_at(hit);
    Surface surface = surface_at(primitive, ray, hit);
    result.position = positive_zeros(surface.p);
    result.t = hit.t;
    result.normal = positive_zeros(surface.normal);
    result.u = positive_zero(surface.uv.x);
    result.normal_geometric = positive_zeros(surface.normal_geometric);
    result.v = positive_zero(surface.uv.y);
    result.cosine = positive_zero(-dot3(ray.d, surface.normal_geometric));
    result.primitive = hit.id;
    result.material = material_of(primitive);
  }
  return result;
}

QueryHit answer(TraversalState state, bool any, uint flags) {
  bool is_hit = any ? state.occluded >= OPTICAL_DEPTH_OPAQUE : state.hit.slot != NONE;
  QueryHit result;
  result.t = is_hit ? (any ? 0.0f : state.hit.t) : T_MISS;
  result.primitive = is_hit && !any ? state.hit.id : NONE;
  result.flags = flags | iteration_limit(state);
  result.occlusion = state.occluded;
  return result;
}

// A single ray: the nearest hit before its t_max, or whether anything keeps its light away.
QueryHit query(QueryRay requested, bool any) {
  Ray ray = make_ray(requested.origin, requested.direction);
  TraversalState state = search(ray, minimum(requested.t_max, T_MISS), any);
  return answer(state, any, loops_cut_off(LOOP_PROBE));
}

SHADER_END
#endif
