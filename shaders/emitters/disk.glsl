// a = the centre, inner²    b, c = the half axes of the ellipse that it is; inner: the radius of its hole, theirs being 1
#ifndef EMITTER_DISK_GLSL
#define EMITTER_DISK_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

EmitterSample disk_emitter_sample(Emitter e, vec3 from, vec2 u) {
  vec2 at = on_disk(u);
  // Out of the hole, by which each ring keeps its share of the area.
  float squared = at.x * at.x + at.y * at.y;
  float grow = squared == 0.0f ? 1.0f : sqrt((e.a.w + squared * (1.0f - e.a.w)) / squared);
  EmitterSample place;
  place.p = vec3(e.a) + (vec3(e.b) * (at.x * grow) + vec3(e.c) * (at.y * grow));
  place.normal = normalize3(cross3(vec3(e.b), vec3(e.c)));
  place.uv = vec2(0.5f + 0.5f * (at.x * grow), 0.5f - 0.5f * (at.y * grow));
  return place;
}

float disk_emitter_density(Emitter e, vec3 from, EmitterSample place) { return density_of_area(e.area, from, place); }

SHADER_END
#endif
