// a = the position, the versine of the cone's outer angle; b = the unit direction that it opens in, 1 / (that less the inner angle's).
#ifndef SPOT_GLSL
#define SPOT_GLSL
#include "lights/photon_aim.glsl"
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

#if HAS_PHOTONS
LightEmission spot_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  Aimed way = aimed(pass, aim_from(vec3(light.a), vec3(0.0f, 0.0f, 0.0f), false, aim, heading), within_cone(vec3(light.b), light.a.w, heading));
  vec3 apart = way.at - vec3(light.b);
  float inside = way.by_aim ? light.a.w - 0.5f * dot3(apart, apart) : light.a.w * (1.0f - heading.x);
  float within = minimum(maximum(inside * light.b.w, 0.0f), 1.0f);
  LightEmission emission;
  emission.o = vec3(light.a);
  emission.d = way.at;
  // 2π².
  emission.flux = light.intensity * (within * within * (19.7392088f * light.a.w) * aimed_weight(way, 0.159154943f / light.a.w));
  emission.aim = aim_event(way);
  return emission;
}
#endif

SHADER_END
#endif
