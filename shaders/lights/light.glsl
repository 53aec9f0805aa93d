// From a light and a point to the light arriving there, and to a photon sent out: calls the kind of light.
#ifndef LIGHT_GLSL
#define LIGHT_GLSL
#include "lights/light_emission.glsl"
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample sample_light(Light light, vec3 p) {
  LightSample s = no_light();
#define SAMPLE_OF(name, number) \
  if (light.kind == number) s = name##_sample(light, p);
  LIGHTS(SAMPLE_OF)
  return s;
}

#if HAS_PHOTONS
// start, heading: two random numbers each; aim: one.
LightEmission light_emission(Light light, PhotonPass pass, vec2 start, vec2 heading, float aim) {
  LightEmission emission = no_emission();
#define EMISSION_OF_LIGHT(name, number) \
  if (light.kind == number) emission = name##_emission(light, pass, start, heading, aim);
  LIGHTS(EMISSION_OF_LIGHT)
  return emission;
}
#endif

SHADER_END
#endif
