// A sphere, as shapes/sphere.glsl has it.
#ifndef EMITTER_SPHERE_GLSL
#define EMITTER_SPHERE_GLSL
#include "emitters/emitter_sample.glsl"
#include "shapes/sphere.glsl"

SHADER_BEGIN

Primitive emitter_sphere(Emitter e) { return primitive_of(uvec4(0u, 0u, 0u, 0u), e.a, e.b, e.c); }

// From outside the cone around the sphere is chosen from, evenly. A point on the sphere is not outside, however it is rounded.
bool sphere_is_seen_from_outside(Primitive sphere, vec3 from) {
  vec3 way = sphere_center(sphere) - from;
  float r = sphere_radius(sphere);
  return dot3(way, way) > 1.0002f * (r * r);
}

// One less the cosine of the cone's half angle, whose sine's square is given: without cancellation.
float versine(float sine_squared) { return sine_squared / (1.0f + sqrt(1.0f - sine_squared)); }

EmitterSample sample_sphere(Primitive sphere, vec3 from, vec2 u) {
  vec3 way = sphere_center(sphere) - from;
  float r = sphere_radius(sphere);
  float squared = dot3(way, way);
  bool outside = sphere_is_seen_from_outside(sphere, from);
  float distance = sqrt(squared);
  vec3 axis = outside ? way / distance : vec3(0.0f, 0.0f, 1.0f);
  float below = outside ? u.x * versine(r * r / squared) : 2.0f * u.x;
  float cosine = 1.0f - below;
  float sine_squared = below * (2.0f - below);
  vec2 turn = sine_cosine(2.0f * PI * u.y);
  vec3 s;
  vec3 t;
  tangents(axis, s, t);
  vec3 d = axis * cosine + (s * turn.y + t * turn.x) * sqrt(maximum(sine_squared, 0.0f));
  float near = distance * cosine - sqrt(maximum(r * r - squared * sine_squared, 0.0f));
  EmitterSample point;
  point.normal = outside ? normalize3(d * near - way) : d;
  point.p = sphere_center(sphere) + point.normal * r;
  point.uv = sphere_uv(sphere, point.normal);
  return point;
}

EmitterSample sphere_emitter_sample(Emitter e, vec3 from, vec2 u) { return sample_sphere(emitter_sphere(e), from, u); }

float sphere_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  Primitive sphere = emitter_sphere(e);
  vec3 way = sphere_center(sphere) - from;
  float r = sphere_radius(sphere);
  float sine_squared = r * r / dot3(way, way);
  return sphere_is_seen_from_outside(sphere, from) ? 1.0f / (2.0f * PI * versine(sine_squared))
                                                   : density_of_area(e.area, from, point);
}

SHADER_END
#endif
