// The centre and the half axes of the ellipse that it is (emitters/emitter_sample.glsl).
#ifndef EMITTER_DISK_GLSL
#define EMITTER_DISK_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

float disk_hole(Emitter e) { return e.a.w; }  // the square of its radius, the half axes being 1

EmitterSample disk_emitter_sample(Emitter e, vec3 from, vec2 u) {
  vec2 at = on_disk(u);
  // Move the point out of the hole, so that each ring keeps its share of the area.
  float squared = at.x * at.x + at.y * at.y;
  float hole = disk_hole(e);
  float grow = squared == 0.0f ? 1.0f : sqrt((hole + squared * (1.0f - hole)) / squared);
  EmitterSample point;
  point.p = emitter_origin(e) + (emitter_edge_u(e) * (at.x * grow) + emitter_edge_v(e) * (at.y * grow));
  point.normal = flat_normal(e);
  point.uv = vec2(0.5f + 0.5f * (at.x * grow), 0.5f - 0.5f * (at.y * grow));
  return point;
}

float disk_emitter_density(Emitter e, vec3 from, EmitterSample point) { return density_of_area(e.area, from, point); }

SHADER_END
#endif
