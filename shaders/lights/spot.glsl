// a = the position, the versine of the cone's outer angle; b = the unit direction that it opens in, 1 / (that less the inner angle's).
#ifndef SPOT_GLSL
#define SPOT_GLSL
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample spot_sample(Light light, vec3 p) {
  vec3 way = vec3(light.a) - p;
  float distance = sqrt(dot3(way, way));
  LightSample s = no_light();
  s.direction = way / distance;
  s.distance = distance;
  // The versine of the angle from the axis: where that is small, its cosine says nothing.
  vec3 apart = s.direction + vec3(light.b);
  float within = minimum(maximum((light.a.w - 0.5f * dot3(apart, apart)) * light.b.w, 0.0f), 1.0f);
  s.color = light.intensity * (within * within / (distance * distance));
  return s;
}

SHADER_END
#endif
