// A photon as a light sends it out.
#ifndef LIGHT_EMISSION_GLSL
#define LIGHT_EMISSION_GLSL
#include "lights/light_sample.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

struct LightEmission {
  vec3 o;
  vec3 d;     // unit
  vec3 flux;  // the emitted light, divided by the density of position and direction
  uint aim;   // its part of the trail (photon_aim.glsl)
};

LightEmission no_emission() {
  LightEmission none;
  none.o = vec3(0.0f, 0.0f, 0.0f);
  none.d = vec3(0.0f, 1.0f, 0.0f);
  none.flux = vec3(0.0f, 0.0f, 0.0f);
  none.aim = 0u;
  return none;
}

// A direction at most as far from the unit vector `axis` as the versine allows, evenly by solid angle.
vec3 within_cone(vec3 axis, float versine, vec2 u) {
  float below = u.x * versine;
  vec2 turn = sine_cosine(2.0f * PI * u.y);
  vec3 s;
  vec3 t;
  tangents(axis, s, t);
  return normalize3(axis * (1.0f - below) + (s * turn.y + t * turn.x) * sqrt(maximum(below * (2.0f - below), 0.0f)));
}

SHADER_END
#endif
