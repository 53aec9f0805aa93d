// What an integrator answers, whichever it is. A step is a function that never traces: the loop (loop.glsl) and the wavefront
// (kernels/wavefront.comp.glsl) call these and trace the rays that they name.
//   NAME_missed      the radiance of a ray that hits nothing
//   NAME_emitted     what a path gains where it arrived, before any shadow ray, not yet weighted by its throughput
//   NAME_shadow_ray  the i-th of shadow_rays(): false where it counts for nothing; else the ray, how far it goes, and what it adds if
//                    nothing is in between, weighted as above
//   NAME_scatter     how the path goes on
#ifndef INTEGRATOR_GLSL
#define INTEGRATOR_GLSL
#include "integrators/interaction.glsl"
#include "integrators/path.glsl"

SHADER_BEGIN

// Whether paths go on.
bool scatters() {
  bool any = false;
#define SCATTERS_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number)) any = scatters;
  INTEGRATORS(SCATTERS_OF)
  return any;
}

// A path that begins at the eye. Media count only for those that go on.
Path begin(Frame frame, Ray camera_ray) {
  Path path;
  path.o = camera_ray.o;
  path.d = camera_ray.d;
  path.throughput = vec3(1.0f, 1.0f, 1.0f);
  path.depth = 0u;
  path.media = scatters() ? frame.media : 0u;
#if RAY_KINDS
  path.refracted = false;
#endif
  return path;
}

uint shadow_rays() {
  uint count = 0u;
#define SHADOW_RAYS_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number) && shadow_rays) count = LIGHT_COUNT;
  INTEGRATORS(SHADOW_RAYS_OF)
  return count;
}

vec3 missed(Frame frame) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
#define MISSED_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number)) light = name##_missed(frame);
  INTEGRATORS(MISSED_OF)
  return light;
}

vec3 emitted(Frame frame, Interaction at) {
  vec3 light = vec3(0.0f, 0.0f, 0.0f);
#define EMITTED_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number)) light = name##_emitted(frame, at);
  INTEGRATORS(EMITTED_OF)
  return light;
}

bool shadow_ray(Frame frame, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution) {
  bool counts = false;
#define SHADOW_RAY_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number)) counts = name##_shadow_ray(frame, at, i, ray, distance, contribution);
  INTEGRATORS(SHADOW_RAY_OF)
  return counts;
}

Continuations scatter(Frame frame, Path path, Interaction at) {
  Continuations all = no_continuation(path);
#define SCATTER_OF(name, number, shadow_rays, scatters) \
  if (INTEGRATOR_IS(number)) all = name##_scatter(frame, path, at);
  INTEGRATORS(SCATTER_OF)
  return all;
}

SHADER_END
#endif
