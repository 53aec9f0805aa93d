// The loop driver: all rays of one sample, one after the other. Where a path goes on in two ways, one waits on a stack.
#ifndef LOOP_GLSL
#define LOOP_GLSL
#include "integrators/vertex.glsl"

SHADER_BEGIN

#if HAS_SECONDARY
vec3 radiance(Frame frame, Ray camera_ray, uint pixel, uint index, INOUT(uvec4) counts, INOUT(uint) trail) {
#if PATH_STACK > 0
  Path stack[PATH_STACK];
  uint pending = 0u;
#endif
#if RAY_KINDS
  uint rays_reflected = 0u;
  uint rays_refracted = 0u;
  uint total_reflections = 0u;
#endif
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
  Path path = begin(frame, camera_ray, pixel, index);
  bool going = true;
  for (; going;) {
    Ray ray = path_ray(frame, path);
    PROBE_RAY(surfaces_behind(path) == 0u ? RAY_EYE : path.refracted ? RAY_REFRACTED : RAY_REFLECTED, 0u, path.depth);
    PROBE(origin, ray.o);
    PROBE(direction, ray.d);
    Hit hit = trace(ray, counts.z);
    Continuations all = shade(frame, path, ray, hit, color, counts, trail);
    going = all.count > 0u;
    path = all.next;

#if PATH_STACK > 0
    if (all.count > 1u) {
      if (pending == uint(PATH_STACK)) {
        counts.z = counts.z | FLAG_STACK_OVERFLOW;
      } else {
        stack[pending] = all.waiting;
        pending += 1u;
      }
    }
    if (!going && pending > 0u) {
      pending -= 1u;
      path = stack[pending];
      going = true;
    }
#endif
#ifdef LOOP_BUDGET
    if (going && counts.w > LOOP_BUDGET) {
      counts.z = counts.z | FLAG_LOOP_BUDGET;
      going = false;
    }
#endif
#if RAY_KINDS
    rays_reflected += going && !path.refracted ? 1u : 0u;
    rays_refracted += going && path.refracted ? 1u : 0u;
    total_reflections += all.total_reflection ? 1u : 0u;
#endif
    // Tested at the bottom, which saves an iteration with all lanes idle. Not so if no loop over lights is inside this one: then Mesa
    // 22.3.6 may take the last results from the iterations of other rays (docs/lavapipe.md).
    if (LIGHT_COUNT > 0u && !going) break;
  }
#if RAY_KINDS
  counts = counts_by_kind(counts, rays_reflected, rays_refracted, total_reflections);
#endif
  return color;
}
#else
// No path goes on: there is nothing to loop for.
vec3 radiance(Frame frame, Ray camera_ray, uint pixel, uint index, INOUT(uvec4) counts, INOUT(uint) trail) {
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
  PROBE_RAY(RAY_EYE, 0u, 0u);
  PROBE(origin, camera_ray.o);
  PROBE(direction, camera_ray.d);
  Path path = begin(frame, camera_ray, pixel, index);
  Ray ray = with_alpha_key(camera_ray, frame, path, 0u);
  Hit hit = trace(ray, counts.z);
  shade(frame, path, ray, hit, color, counts, trail);
#if RAY_KINDS
  counts = counts_by_kind(counts, 0u, 0u, 0u);
#endif
  return color;
}
#endif

SHADER_END
#endif
