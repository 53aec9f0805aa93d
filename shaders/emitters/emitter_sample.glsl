// A point on an emitter, as another point sees it.
#ifndef EMITTER_SAMPLE_GLSL
#define EMITTER_SAMPLE_GLSL
#include "math/sampling.glsl"
#include "records.h"

SHADER_BEGIN

// The values of flat kinds: the centre or a corner, and from there half axes or edges.
vec3 emitter_origin(Emitter e) { return vec3(e.a); }
vec3 emitter_edge_u(Emitter e) { return vec3(e.b); }
vec3 emitter_edge_v(Emitter e) { return vec3(e.c); }
vec3 flat_normal(Emitter e) { return normalize3(cross3(emitter_edge_u(e), emitter_edge_v(e))); }

struct EmitterSample {
  vec3 p;
  vec3 normal;  // unit, of either side; outward on closed shapes
  vec2 uv;      // as textures have it; of a triangle the weights of the second and the third corner
};

// The density, by solid angle at `from`, of a point chosen evenly on `area`.
float density_of_area(float area, vec3 from, EmitterSample point) {
  vec3 way = point.p - from;
  float squared = dot3(way, way);
  return squared * sqrt(squared) / (area * maximum(abs(dot3(way, point.normal)), 1.0e-30f));
}

SHADER_END
#endif
