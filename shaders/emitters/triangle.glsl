// a = a corner    b, c = the edges from there
#ifndef EMITTER_TRIANGLE_GLSL
#define EMITTER_TRIANGLE_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

EmitterSample triangle_emitter_sample(Emitter e, vec3 from, vec2 u) {
  // Osada et al., "Shape Distributions" (TOG 2002).
  float root = sqrt(u.x);
  EmitterSample place;
  place.p = vec3(e.a) + (vec3(e.b) * (root * (1.0f - u.y)) + vec3(e.c) * (root * u.y));
  place.normal = normalize3(cross3(vec3(e.b), vec3(e.c)));
  place.uv = vec2(root * (1.0f - u.y), root * u.y);
  return place;
}

float triangle_emitter_density(Emitter e, vec3 from, EmitterSample place) { return density_of_area(e.area, from, place); }

SHADER_END
#endif
