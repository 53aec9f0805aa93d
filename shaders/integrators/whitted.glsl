// Whitted's illumination model ("An Improved Illumination Model for Shaded Display", CACM 1980): direct light with shadows, and perfect
// mirrors and refraction.
#ifndef WHITTED_GLSL
#define WHITTED_GLSL
#include "emitters/environment.glsl"
#include "integrators/continuation.glsl"
#include "integrators/interaction.glsl"
#include "lights/light.glsl"

SHADER_BEGIN

vec3 whitted_missed(Frame frame, Path path) { return surroundings(frame, path.d); }

// The ambient light, and the surface's own.
vec3 whitted_emitted(Frame frame, Path path, Interaction at) {
  vec3 color = at.scattering.ambient * frame.ambient;
  if (HAS_EMISSION == 1) color = color + at.scattering.emitted;
  return color;
}

// The shadow ray to light i; true if the light is in front.
bool whitted_shadow_ray(Frame frame, Path path, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  LightSample s = sample_light(load_light(i), at.seen.p);
  float cosine = dot3(at.seen.normal, s.direction);
  distance = s.distance;
  ray = spawn_to_light(at.seen, s.direction, true, distance);
  float lobe = highlight(at.material, at.seen.normal, s.direction, -at.d);
  contribution = s.color * (at.scattering.diffuse * cosine + at.scattering.specular * lobe);
  light = i;
  return cosine > 0.0f && dot3(side_normal(at.seen), s.direction) > 0.0f;
}

// Reflection and refraction, each where it counts for enough. If both do, the refracted ray is next.
Continuations whitted_scatter(Frame frame, Path path, Interaction at) {
  Continuations all = no_continuation(path);
  bool deeper = path.depth < frame.max_depth;
  Path reflected = path;
  reflected.d = reflected_direction(at);
  reflected.o = scattered_origin(at, reflected.d, true);
  reflected.throughput = path.throughput * at.scattering.reflected;
  reflected.depth = path.depth + 1u;
#if RAY_KINDS
  reflected.refracted = false;
#endif
  bool reflects = deeper && max_component(reflected.throughput) > frame.min_throughput;
  all.next = reflected;
  all.count = reflects ? 1u : 0u;
#if HAS_MEDIA
  Path transmitted = path;
  transmitted.d = refracted_direction(at);
  transmitted.o = spawn_ray(at.surface, transmitted.d).o;
  transmitted.throughput = path.throughput * at.scattering.transmitted;
  transmitted.depth = path.depth + 1u;
  transmitted.media = at.media_behind;
#if RAY_KINDS
  transmitted.refracted = true;
  all.total_reflection = deeper && at.material.medium != 0u && max_component(at.scattering.transmitted) == 0.0f;
#endif
  bool transmits = deeper && max_component(transmitted.throughput) > frame.min_throughput;
  all.waiting = reflected;
  if (transmits) all.next = transmitted;
  all.count += transmits ? 1u : 0u;
#endif
  return all;
}

SHADER_END
#endif
