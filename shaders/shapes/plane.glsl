// n·x = d.   a = n, d    b = U, U0    c = V, V0: u = U·x + U0, v = V·x + V0
#ifndef PLANE_GLSL
#define PLANE_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// A ray in the plane or parallel to it divides by zero: infinity and NaN are both misses, no epsilon decides.
float plane_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 n = vec3(s.a);
  return (s.a.w - dot3(n, ray.o)) / dot3(n, ray.d);
}

// Never asked: what is unbounded is in no BVH.
bool plane_reject(Primitive s, Ray ray) { return false; }
void plane_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = vec3(-T_MISS, -T_MISS, -T_MISS);
  upper = vec3(T_MISS, T_MISS, T_MISS);
}

Surface plane_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = vec3(s.a);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * (dot3(n, p) - s.a.w);

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = vec2(dot3(vec3(s.b), p) + s.b.w, dot3(vec3(s.c), p) + s.c.w);
  set_gradients(surface, vec3(s.b), vec3(s.c));
  surface.offset = 4.0f * EPSILON * (dot3(abs3(n), abs3(p)) + abs(s.a.w));
  return surface;
}

SHADER_END
#endif
