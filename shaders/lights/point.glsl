// It shines from one point to all sides.
#ifndef POINT_GLSL
#define POINT_GLSL
#include "lights/photon_aim.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

vec3 point_position(Light light) { return vec3(light.a); }
bool point_falls_off(Light light) { return light.a.w != 0.0f; }  // with the square of the distance

LightSample point_sample(Light light, vec3 p) {
  vec3 way = point_position(light) - p;
  float distance = sqrt(dot3(way, way));
  LightSample s = no_light();
  s.direction = way / distance;
  s.distance = distance;
  s.color = point_falls_off(light) ? light.intensity / (distance * distance) : light.intensity;
  return s;
}

#if HAS_PHOTONS
LightEmission point_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  Aimed way = aimed(pass, aim_from(point_position(light), vec3(0.0f, 0.0f, 0.0f), false, aim, heading), within_cone(vec3(0.0f, 1.0f, 0.0f), 2.0f, heading));
  LightEmission emission;
  emission.o = point_position(light);
  emission.d = way.at;
  // Compilers round products of constants differently: this is 4π².
  emission.flux = light.intensity * (39.4784176f * aimed_weight(way, 0.0795774715f));
  emission.aim = aim_event(way);
  return emission;
}
#endif

SHADER_END
#endif
