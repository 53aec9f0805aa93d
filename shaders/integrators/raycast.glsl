// Camera rays only: the base colour, shaded by light and normal, without shadows.
#ifndef RAYCAST_GLSL
#define RAYCAST_GLSL
#include "emitters/environment.glsl"
#include "integrators/continuation.glsl"
#include "integrators/interaction.glsl"
#include "lights/light.glsl"
#include "textures/texture.glsl"

SHADER_BEGIN

vec3 raycast_missed(Frame frame, Path path) { return surroundings(frame, path.d); }

vec3 raycast_emitted(Frame frame, Path path, Interaction at) {
  // Add up the lights; without any, the viewer holds one.
  vec3 light = frame.ambient;
  for (uint i = 0u; i < LIGHT_COUNT; i++) {
    LightSample s = sample_light(load_light(i), at.seen.p);
    float cosine = dot3(at.seen.normal, s.direction);
    light = cosine > 0.0f ? light + s.color * cosine : light;
  }
  float headlight = abs(dot3(at.seen.normal, at.d));
  if (LIGHT_COUNT == 0u) light = vec3(headlight, headlight, headlight);
  vec3 base = color_of(at.material, at.context.point);
#if HAS_EMISSION
  base = base + emission_of(at.material, at.context.point);
#endif
#if HAS_COLORS
  base = base * at.context.color;
#endif
  return base * light;
}

bool raycast_shadow_ray(Frame frame, Path path, Interaction at, uint i, OUT(Ray) ray, OUT(float) distance, OUT(vec3) contribution, OUT(uint) light) {
  ray = make_ray(at.seen.p, at.d);
  distance = 0.0f;
  light = i;
  contribution = vec3(0.0f, 0.0f, 0.0f);
  return false;
}

Continuations raycast_scatter(Frame frame, Path path, Interaction at) { return no_continuation(path); }

SHADER_END
#endif
