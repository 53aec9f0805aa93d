// A place on an emitter, as a point sees it.
#ifndef EMITTER_SAMPLE_GLSL
#define EMITTER_SAMPLE_GLSL
#include "math/trigonometry.glsl"
#include "records.h"

SHADER_BEGIN

struct EmitterSample {
  vec3 p;
  vec3 normal;  // unit, of either side
};

// The density, by solid angle at `from`, of a place chosen evenly on `area`.
float density_of_area(float area, vec3 from, EmitterSample place) {
  vec3 way = place.p - from;
  float squared = dot3(way, way);
  return squared * sqrt(squared) / (area * maximum(abs(dot3(way, place.normal)), 1.0e-30f));
}

// Evenly on the disk of radius 1, by squares within squares: Shirley and Chiu, "A Low Distortion Map Between Disk and Square" (1997).
vec2 on_disk(vec2 u) {
  float x = 2.0f * u.x - 1.0f;
  float y = 2.0f * u.y - 1.0f;
  bool wide = abs(x) > abs(y);
  float radius = wide ? x : y;
  float angle = radius == 0.0f ? 0.0f : wide ? 0.25f * PI * (y / x) : 0.5f * PI - 0.25f * PI * (x / y);
  vec2 at = sine_cosine(angle);
  return vec2(radius * at.y, radius * at.x);
}

// Two directions that are square to the unit vector n and to each other. The first turns about an axis that no wall stands along.
void tangents(vec3 n, OUT(vec3) s, OUT(vec3) t) {
  s = normalize3(cross3(vec3(0.31753204f, 0.90757246f, 0.27474649f), n));
  t = cross3(n, s);
}

SHADER_END
#endif
