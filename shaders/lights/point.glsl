// a = the position; its w is not 0 where the light falls off with the square of the distance.
#ifndef POINT_GLSL
#define POINT_GLSL
#include "lights/photon_aim.glsl"
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

#if HAS_PHOTONS
LightEmission point_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  Aimed way = aimed(pass, aim_from(vec3(light.a), vec3(0.0f, 0.0f, 0.0f), false, aim, heading), within_cone(vec3(0.0f, 1.0f, 0.0f), 2.0f, heading));
  LightEmission emission;
  emission.o = vec3(light.a);
  emission.d = way.at;
  // Compilers round products of constants at different places: this is 4π².
  emission.flux = light.intensity * (39.4784176f * aimed_weight(way, 0.0795774715f));
  emission.aim = aim_event(way);
  return emission;
}
#endif

SHADER_END
#endif
