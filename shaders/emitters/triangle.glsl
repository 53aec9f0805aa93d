// a = a corner    b, c = the edges from there
#ifndef EMITTER_TRIANGLE_GLSL
#define EMITTER_TRIANGLE_GLSL
#include "emitters/spherical_triangle.glsl"

SHADER_BEGIN

EmitterSample triangle_emitter_sample(Emitter e, vec3 from, vec2 u) {
  SphericalTriangle seen = spherical_triangle(vec3(e.a) - from, vec3(e.b), vec3(e.c));
  // By area: Osada et al., "Shape Distributions" (TOG 2002).
  float root = sqrt(u.x);
  vec2 weights = vec2(root * (1.0f - u.y), root * u.y);
  if (is_by_solid_angle(seen)) weights = spherical_triangle_place(seen, u);
  EmitterSample place;
  place.p = vec3(e.a) + (vec3(e.b) * weights.x + vec3(e.c) * weights.y);
  place.normal = normalize3(cross3(vec3(e.b), vec3(e.c)));
  place.uv = weights;
  return place;
}

float triangle_emitter_density(Emitter e, vec3 from, EmitterSample place) {
  SphericalTriangle seen = spherical_triangle(vec3(e.a) - from, vec3(e.b), vec3(e.c));
  return is_by_solid_angle(seen) ? 1.0f / (2.0f * seen.half_angle) : density_of_area(e.area, from, place);
}

SHADER_END
#endif
