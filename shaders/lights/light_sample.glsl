// A light as a point sees it.
#ifndef LIGHT_SAMPLE_GLSL
#define LIGHT_SAMPLE_GLSL
#include "math/math.glsl"
#include "records.h"

SHADER_BEGIN

struct LightSample {
  vec3 direction;  // unit, towards the light
  float distance;  // T_MISS for a light without a position
  vec3 color;      // color of the light that arrives when nothing is in between
  float versine;   // versine of half the angle under which it is seen: one less the cosine; 0 of a light that is a point
};

LightSample no_light() {
  LightSample s;
  s.direction = vec3(0.0f, 0.0f, 0.0f);
  s.distance = T_MISS;
  s.color = vec3(0.0f, 0.0f, 0.0f);
  s.versine = 0.0f;
  return s;
}

SHADER_END
#endif
