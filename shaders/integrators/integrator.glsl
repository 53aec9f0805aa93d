// The interface of integrators. A step is a function that never traces: the loop (loop.glsl) and the wavefront
// (kernels/wavefront.comp.glsl) call these and trace the rays that they name.
//   NAME_missed      the radiance of a ray that hits nothing.
//   NAME_emitted     the path's gain where it arrived, before any shadow ray, not yet weighted by its throughput.
//   NAME_shadow_ray  the i-th of shadow_rays(): false where it counts for nothing. Else the ray, its length, and the light that it adds if
//                    nothing is in between, weighted as above; and to which light.
//   NAME_scatter     how the path goes on
#ifndef INTEGRATOR_GLSL
#define INTEGRATOR_GLSL
#include "integrators/continuation.glsl"
#include "integrators/interaction.glsl"

SHADER_BEGIN

// True if paths go on.
bool scatters() {
  bool any = false;
#define SCATTERS_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) any = ways > 0u;
  INTEGRATORS(SCATTERS_OF)
  return any;
}

#define WALKS_TO_no_light false
#define WALKS_TO_each_light false
#define WALKS_TO_one_light true
// True if paths go on at random.
bool walks_at_random() {
  bool any = false;
#define WALKS_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) any = WALKS_TO_##lights;
  INTEGRATORS(WALKS_OF)
  return any;
}

// The path of a pixel's sample that begins at the eye. Media count only for those that go on.
Path begin(Frame frame, Ray camera_ray, uint pixel, uint index) {
  Path path;
  path.o = camera_ray.o;
  path.d = camera_ray.d;
  path.throughput = vec3(1.0f, 1.0f, 1.0f);
  path.depth = 0u;
  path.media = scatters() ? frame.media : 0u;
#if RANDOM_WALK
  path.density = 0.0f;
  path.normal = vec3(0.0f, 0.0f, 0.0f);
#endif
#if KEEPS_POINT
  path.point = path.o;
#endif
#if RANDOM_WALK || HAS_BLEND
  path.pixel = pixel;
  path.index = index;
#endif
#if RANDOM_WALK
#if HAS_PANES
  path.from = path.o;
  path.panes = 0u;
  path.past_panes = 0u;
#endif
#endif
#if RAY_KINDS
  path.refracted = false;
#endif
  return path;
}

#define SHADOW_RAYS_TO_no_light 0u
#define SHADOW_RAYS_TO_each_light LIGHT_COUNT
#define SHADOW_RAYS_TO_one_light (EMITTER_COUNT > 0u || HAS_ENVIRONMENT_LIGHT ? 1u : 0u)
uint shadow_rays() {
  uint count = 0u;
#define SHADOW_RAYS_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) count = SHADOW_RAYS_TO_##lights;
  INTEGRATORS(SHADOW_RAYS_OF)
  return count;
}

vec3 missed(Frame frame, Path path) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
#define MISSED_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) light = name##_missed(frame, path);
  INTEGRATORS(MISSED_OF)
  return light;
}

vec3 emitted(Frame frame, Path path, Interaction at) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
#define EMITTED_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) light = name##_emitted(frame, path, at);
  INTEGRATORS(EMITTED_OF)
  return light;
}

bool shadow_ray(Frame frame, Path path, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  bool counts = false;
#define SHADOW_RAY_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) counts = name##_shadow_ray(frame, path, at, i, ray, distance, contribution, light);
  INTEGRATORS(SHADOW_RAY_OF)
  ray = with_alpha_key(ray, frame, path, 1u + i);
  return counts;
}

Continuations scatter(Frame frame, Path path, Interaction at) {
  Continuations all = no_continuation(path);
#define SCATTER_OF(name, number, lights, ways) \
  if (INTEGRATOR_IS(number)) all = name##_scatter(frame, path, at);
  INTEGRATORS(SCATTER_OF)
  return all;
}

SHADER_END
#endif
