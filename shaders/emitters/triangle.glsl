// A corner and the edges from there (emitters/emitter_sample.glsl).
#ifndef EMITTER_TRIANGLE_GLSL
#define EMITTER_TRIANGLE_GLSL
#include "emitters/spherical_triangle.glsl"

SHADER_BEGIN

EmitterSample triangle_emitter_sample(Emitter e, vec3 from, vec2 u) {
  SphericalTriangle seen = spherical_triangle(emitter_origin(e) - from, emitter_edge_u(e), emitter_edge_v(e));
  // By area: Osada et al., "Shape Distributions" (TOG 2002).
  float root = sqrt(u.x);
  vec2 weights = vec2(root * (1.0f - u.y), root * u.y);
  if (is_by_solid_angle(seen)) weights = spherical_triangle_weights(seen, u);
  EmitterSample point;
  point.p = emitter_origin(e) + (emitter_edge_u(e) * weights.x + emitter_edge_v(e) * weights.y);
  point.normal = flat_normal(e);
  point.uv = weights;
  return point;
}

float triangle_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  SphericalTriangle seen = spherical_triangle(emitter_origin(e) - from, emitter_edge_u(e), emitter_edge_v(e));
  return is_by_solid_angle(seen) ? 1.0f / (2.0f * seen.half_angle) : density_of_area(e.area, from, point);
}

SHADER_END
#endif
