// a = the unit direction towards the light; its w the versine of half the angle under which it is seen.
#ifndef DIRECTIONAL_GLSL
#define DIRECTIONAL_GLSL
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample directional_sample(Light light, vec3 p) {
  LightSample s = no_light();
  s.direction = vec3(light.a);
  s.distance = T_MISS;
  s.color = light.intensity;
  s.versine = light.a.w;
  return s;
}

SHADER_END
#endif
