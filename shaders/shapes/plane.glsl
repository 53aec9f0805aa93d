// n·x = d.
#ifndef PLANE_GLSL
#define PLANE_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

vec3 plane_normal(Primitive s) { return vec3(s.a); }
float plane_distance(Primitive s) { return s.a.w; }
vec4 plane_u(Primitive s) { return s.b; }  // U, U0: u = U·x + U0
vec4 plane_v(Primitive s) { return s.c; }  // V, V0: v = V·x + V0

// A ray in the plane or parallel to it divides by zero: infinity and NaN are both misses, no epsilon decides.
float plane_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 n = plane_normal(s);
  return (plane_distance(s) - dot3(n, ray.o)) / dot3(n, ray.d);
}

// Never called: an unbounded shape is in no BVH.
bool plane_reject(Primitive s, Ray ray) { return false; }
void plane_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = vec3(-T_MISS, -T_MISS, -T_MISS);
  upper = vec3(T_MISS, T_MISS, T_MISS);
}

Surface plane_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = plane_normal(s);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * (dot3(n, p) - plane_distance(s));
  vec4 u = plane_u(s);
  vec4 v = plane_v(s);

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = vec2(dot3(vec3(u), p) + u.w, dot3(vec3(v), p) + v.w);
  set_gradients(surface, vec3(u), vec3(v));
  surface.offset = 4.0f * EPSILON * (dot3(abs3(n), abs3(p)) + abs(plane_distance(s)));
  return surface;
}

SHADER_END
#endif
