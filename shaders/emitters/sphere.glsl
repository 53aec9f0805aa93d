// a = the centre, r    b = the pole    c = the meridian u = ½, handedness: as shapes/sphere.glsl has them
#ifndef EMITTER_SPHERE_GLSL
#define EMITTER_SPHERE_GLSL
#include "emitters/emitter_sample.glsl"
#include "shapes/sphere.glsl"

SHADER_BEGIN

// From outside the cone around the sphere is chosen from, evenly. A point on the sphere is not outside, however it is rounded.
bool sphere_is_seen_from_outside(Emitter e, vec3 from) {
  vec3 way = vec3(e.a) - from;
  return dot3(way, way) > 1.0002f * (e.a.w * e.a.w);
}

// One less the cosine of the cone's half angle, whose sine's square is given: without cancellation.
float versine(float sine_squared) { return sine_squared / (1.0f + sqrt(1.0f - sine_squared)); }

EmitterSample sphere_emitter_sample(Emitter e, vec3 from, vec2 u) {
  vec3 way = vec3(e.a) - from;
  float squared = dot3(way, way);
  bool outside = sphere_is_seen_from_outside(e, from);
  float distance = sqrt(squared);
  vec3 axis = outside ? way / distance : vec3(0.0f, 0.0f, 1.0f);
  float below = outside ? u.x * versine(e.a.w * e.a.w / squared) : 2.0f * u.x;
  float cosine = 1.0f - below;
  float sine_squared = below * (2.0f - below);
  vec2 turn = sine_cosine(2.0f * PI * u.y);
  vec3 s;
  vec3 t;
  tangents(axis, s, t);
  vec3 d = axis * cosine + (s * turn.y + t * turn.x) * sqrt(maximum(sine_squared, 0.0f));
  float near = distance * cosine - sqrt(maximum(e.a.w * e.a.w - squared * sine_squared, 0.0f));
  EmitterSample place;
  place.normal = outside ? normalize3(d * near - way) : d;
  place.p = vec3(e.a) + place.normal * e.a.w;
  Primitive sphere;
  sphere.b = e.b;
  sphere.c = e.c;
  place.uv = sphere_uv(sphere, place.normal);
  return place;
}

float sphere_emitter_density(Emitter e, vec3 from, EmitterSample place) {
  vec3 way = vec3(e.a) - from;
  float sine_squared = e.a.w * e.a.w / dot3(way, way);
  return sphere_is_seen_from_outside(e, from) ? 1.0f / (2.0f * PI * versine(sine_squared))
                                              : density_of_area(e.area, from, place);
}

SHADER_END
#endif
