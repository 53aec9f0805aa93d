// a = the position; its w is not 0 where the light falls off with the square of the distance.
#ifndef POINT_GLSL
#define POINT_GLSL
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample point_sample(Light light, vec3 p) {
  vec3 way = vec3(light.a) - p;
  float distance = sqrt(dot3(way, way));
  LightSample s = no_light();
  s.direction = way / distance;
  s.distance = distance;
  s.color = light.a.w != 0.0f ? light.intensity / (distance * distance) : light.intensity;
  return s;
}

SHADER_END
#endif
