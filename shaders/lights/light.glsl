// Lights as a point sees them.
#ifndef LIGHT_GLSL
#define LIGHT_GLSL
#include "math/math.glsl"
#include "records.h"

SHADER_BEGIN

struct LightSample {
  vec3 direction;  // unit, towards the light
  float distance;  // T_MISS for a directional light
  vec3 color;      // what arrives when nothing is in between
};

LightSample sample_light(Light light, vec3 p) {
  LightSample s;
  vec3 way = vec3(light.position) - p;
  float distance = sqrt(dot3(way, way));
  bool point = light.head.x == LIGHT_POINT;
  bool weakened = point && light.head.y == FALLOFF_INVERSE_SQUARE;
  s.direction = point ? way / distance : vec3(light.position);
  s.distance = point ? distance : T_MISS;
  s.color = weakened ? vec3(light.intensity) / (distance * distance) : vec3(light.intensity);
  return s;
}

SHADER_END
#endif
