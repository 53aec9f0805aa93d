// It shines from so far away that it comes from one direction.
#ifndef DIRECTIONAL_GLSL
#define DIRECTIONAL_GLSL
#include "lights/photon_aim.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

vec3 directional_towards(Light light) { return vec3(light.a); }  // the unit direction to the light
float directional_versine(Light light) { return light.a.w; }  // versine of half the angle under which it is seen

LightSample directional_sample(Light light, vec3 p) {
  LightSample s = no_light();
  s.direction = directional_towards(light);
  s.distance = T_MISS;
  s.color = light.intensity;
  s.versine = directional_versine(light);
  return s;
}

#if HAS_PHOTONS
LightEmission directional_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  vec3 towards = directional_versine(light) > 0.0f ? within_cone(directional_towards(light), directional_versine(light), heading) : directional_towards(light);
  LightEmission emission = from_afar(pass, towards, start, aim);
  emission.flux = light.intensity * (2.0f * PI / (2.0f - directional_versine(light)) * emission.flux.x);
  return emission;
}
#endif

SHADER_END
#endif
