// a = the unit direction towards the light; its w the versine of half the angle under which it is seen.
#ifndef DIRECTIONAL_GLSL
#define DIRECTIONAL_GLSL
#include "lights/photon_aim.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample directional_sample(Light light, vec3 p) {
  LightSample s = no_light();
  s.direction = vec3(light.a);
  s.distance = T_MISS;
  s.color = light.intensity;
  s.versine = light.a.w;
  return s;
}

#if HAS_PHOTONS
LightEmission directional_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  vec3 towards = light.a.w > 0.0f ? within_cone(vec3(light.a), light.a.w, heading) : vec3(light.a);
  LightEmission emission = from_afar(pass, towards, start, aim);
  emission.flux = light.intensity * (2.0f * PI / (2.0f - light.a.w) * emission.flux.x);
  return emission;
}
#endif

SHADER_END
#endif
