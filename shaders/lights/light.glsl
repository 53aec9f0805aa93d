// From a light and a point to what arrives there: asks the kind of light.
#ifndef LIGHT_GLSL
#define LIGHT_GLSL
#include "lights/light_sample.glsl"

SHADER_BEGIN

LightSample sample_light(Light light, vec3 p) {
  LightSample s = no_light();
#define SAMPLE_OF(name, number) \
  if (light.kind == number) s = name##_sample(light, p);
  LIGHTS(SAMPLE_OF)
  return s;
}

SHADER_END
#endif
