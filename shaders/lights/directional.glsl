// a = the unit direction towards the light.
#ifndef DIRECTIONAL_GLSL
#define DIRECTIONAL_GLSL
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample directional_sample(Light light, vec3 p) {
  LightSample s;
  s.direction = vec3(light.a);
  s.distance = T_MISS;
  s.color = light.intensity;
  return s;
}

SHADER_END
#endif
