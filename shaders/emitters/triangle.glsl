// a = a corner    b, c = the edges from there
#ifndef EMITTER_TRIANGLE_GLSL
#define EMITTER_TRIANGLE_GLSL
#include "emitters/place.glsl"

SHADER_BEGIN

Place triangle_place_on(Emitter e, vec3 from, vec2 u) {
  // Osada et al., "Shape Distributions" (TOG 2002).
  float root = sqrt(u.x);
  Place place;
  place.p = vec3(e.a) + (vec3(e.b) * (root * (1.0f - u.y)) + vec3(e.c) * (root * u.y));
  place.normal = normalize3(cross3(vec3(e.b), vec3(e.c)));
  return place;
}

float triangle_density(Emitter e, vec3 from, Place place) { return density_of_area(e.area, from, place); }

SHADER_END
#endif
