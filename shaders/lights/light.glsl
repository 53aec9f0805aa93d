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
  vec3 way = vec3(light.a) - p;
  float distance = sqrt(dot3(way, way));
  bool point = light.kind == LIGHT_POINT;
  bool weakened = point && light.a.w != 0.0f;
  s.direction = point ? way / distance : vec3(light.a);
  s.distance = point ? distance : T_MISS;
  s.color = weakened ? light.intensity / (distance * distance) : light.intensity;
  return s;
}

SHADER_END
#endif
