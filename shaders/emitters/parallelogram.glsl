// a = a corner    b, c = the edges from there
#ifndef EMITTER_PARALLELOGRAM_GLSL
#define EMITTER_PARALLELOGRAM_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

EmitterSample parallelogram_emitter_sample(Emitter e, vec3 from, vec2 u) {
  EmitterSample place;
  place.p = vec3(e.a) + (vec3(e.b) * u.x + vec3(e.c) * u.y);
  place.normal = normalize3(cross3(vec3(e.b), vec3(e.c)));
  place.uv = u;
  return place;
}

float parallelogram_emitter_density(Emitter e, vec3 from, EmitterSample place) { return density_of_area(e.area, from, place); }

SHADER_END
#endif
