// Lights without a position that are seen under an angle, as the sun is: disks of light behind all else.
#ifndef LIGHT_DISK_GLSL
#define LIGHT_DISK_GLSL
#include "emitters/emitter_sample.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

// The radiance at which it brings as much light as one without an angle: π times its intensity.
vec3 disk_radiance(LightSample light) { return light.color / (light.versine * (2.0f - light.versine)); }

// The density by solid angle, the same in all of the disk.
float disk_density(LightSample light) { return 1.0f / (2.0f * PI * light.versine); }

vec3 disk_direction(LightSample light, vec2 u) {
  float below = u.x * light.versine;
  vec2 turn = sine_cosine(2.0f * PI * u.y);
  vec3 s;
  vec3 t;
  tangents(light.direction, s, t);
  return normalize3(light.direction * (1.0f - below) + (s * turn.y + t * turn.x) * sqrt(below * (2.0f - below)));
}

// The versine is half the square of the distance between the two directions.
bool in_disk(LightSample light, vec3 d) {
  vec3 apart = d - light.direction;
  return dot3(apart, apart) < 2.0f * light.versine;
}

SHADER_END
#endif
