// It shines from one point into a cone.
#ifndef SPOT_GLSL
#define SPOT_GLSL
#include "lights/photon_aim.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

vec3 spot_position(Light light) { return vec3(light.a); }
float spot_versine(Light light) { return light.a.w; }  // versine of the cone's outer angle
vec3 spot_axis(Light light) { return vec3(light.b); }  // the unit direction that it opens in
float spot_steepness(Light light) { return light.b.w; }  // 1 / (the outer angle's versine − the inner one's)

LightSample spot_sample(Light light, vec3 p) {
  vec3 way = spot_position(light) - p;
  float distance = sqrt(dot3(way, way));
  LightSample s = no_light();
  s.direction = way / distance;
  s.distance = distance;
  // The versine of the angle from the axis: where that is small, its cosine has no digits left.
  vec3 apart = s.direction + spot_axis(light);
  float within = minimum(maximum((spot_versine(light) - 0.5f * dot3(apart, apart)) * spot_steepness(light), 0.0f), 1.0f);
  s.color = light.intensity * (within * within / (distance * distance));
  return s;
}

#if HAS_PHOTONS
LightEmission spot_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  Aimed way = aimed(pass, aim_from(spot_position(light), vec3(0.0f, 0.0f, 0.0f), false, aim, heading), within_cone(spot_axis(light), spot_versine(light), heading));
  vec3 apart = way.at - spot_axis(light);
  float inside = way.by_aim ? spot_versine(light) - 0.5f * dot3(apart, apart) : spot_versine(light) * (1.0f - heading.x);
  float within = minimum(maximum(inside * spot_steepness(light), 0.0f), 1.0f);
  LightEmission emission;
  emission.o = spot_position(light);
  emission.d = way.at;
  // 2π².
  emission.flux = light.intensity * (within * within * (19.7392088f * spot_versine(light)) * aimed_weight(way, 0.159154943f / spot_versine(light)));
  emission.aim = aim_event(way);
  return emission;
}
#endif

SHADER_END
#endif
