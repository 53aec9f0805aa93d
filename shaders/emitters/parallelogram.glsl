// A corner and the edges from there (emitters/emitter_sample.glsl), at no right angle (for that: emitters/rectangle.glsl)
#ifndef EMITTER_PARALLELOGRAM_GLSL
#define EMITTER_PARALLELOGRAM_GLSL
#include "emitters/spherical_triangle.glsl"

SHADER_BEGIN

// The parallelogram as two triangles of one apex, on either side of the diagonal.
struct SphericalParallelogram {
  SphericalTriangle low;   // with the edge b, …
  SphericalTriangle high;  // … with the edge c
};

SphericalParallelogram spherical_parallelogram(Emitter e, vec3 from) {
  vec3 b = emitter_edge_u(e);
  vec3 c = emitter_edge_v(e);
  SphericalParallelogram seen;
  seen.low = spherical_triangle(emitter_origin(e) - from, b, b + c);
  seen.high = spherical_triangle(emitter_origin(e) - from, b + c, c);
  return seen;
}

float half_angle_of(SphericalParallelogram seen) { return seen.low.half_angle + seen.high.half_angle; }

bool is_by_solid_angle(SphericalParallelogram seen) {
  float angle = 2.0f * half_angle_of(seen);
  return angle >= LEAST_SPHERICAL_TRIANGLE && angle <= MOST_SOLID_ANGLE;
}

EmitterSample parallelogram_emitter_sample(Emitter e, vec3 from, vec2 u) {
  SphericalParallelogram seen = spherical_parallelogram(e, from);
  // Around the apex, from b to c: one triangle ends where the other begins, so that neighbouring numbers give neighbouring
  // points.
  float turn = u.y * half_angle_of(seen);
  bool low = turn < seen.low.half_angle || seen.high.half_angle == 0.0f;
  SphericalTriangle part;
  if (low) part = seen.low;
  if (!low) part = seen.high;
  float rest = (low ? turn : turn - seen.low.half_angle) / maximum(part.half_angle, 1.0e-30f);
  vec2 weights = spherical_triangle_weights(part, vec2(u.x, minimum(rest, 1.0f)));
  vec2 spherical = low ? vec2(weights.x + weights.y, weights.y) : vec2(weights.x, weights.x + weights.y);
  vec2 at = u;
  if (is_by_solid_angle(seen)) at = spherical;
  EmitterSample point;
  point.p = emitter_origin(e) + (emitter_edge_u(e) * at.x + emitter_edge_v(e) * at.y);
  point.normal = flat_normal(e);
  point.uv = at;
  return point;
}

float parallelogram_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  SphericalParallelogram seen = spherical_parallelogram(e, from);
  return is_by_solid_angle(seen) ? 1.0f / (2.0f * half_angle_of(seen)) : density_of_area(e.area, from, point);
}

SHADER_END
#endif
