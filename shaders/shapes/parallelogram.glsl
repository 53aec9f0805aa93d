// Three corners (geometry/corners.glsl): the origin and the ends of the edges along u and v.   extra: the fourth
#ifndef PARALLELOGRAM_GLSL
#define PARALLELOGRAM_GLSL
#include "geometry/corners.glsl"
#include "geometry/outline.glsl"

SHADER_BEGIN

vec3 corner_d(Primitive s) { return vec3(bits_to_floats(load_vertex(s.extra))); }

float parallelogram_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 a = seen_along(ray, corner_a(s));
  vec3 b = seen_along(ray, corner_b(s));
  vec3 c = seen_along(ray, corner_c(s));
  vec3 opposite = corner_d(s);
  vec3 d = seen_along(ray, opposite);
  bool inside = (crosses(a, b) != crosses(b, d)) != (crosses(d, c) != crosses(c, a));

  // Far from the eye rounded corners make no parallelogram: the bounds have room for the fourth.
  vec3 n = corner_normal(s);
  vec3 from_start = corner_a(s) - ray.o;
  vec3 along_u = (corner_b(s) - corner_a(s)) * 0.5f;
  vec3 along_v = (corner_c(s) - corner_a(s)) * 0.5f;
  vec3 skew = abs3((opposite - corner_b(s)) - (corner_c(s) - corner_a(s)));
  float t = t_within(ray, dot3(n, from_start) / dot3(n, ray.d), from_start + (along_u + along_v),
                     abs3(along_u) + abs3(along_v) + skew);
  return inside ? t : -1.0f;
}

bool parallelogram_reject(Primitive s, Ray ray) { return false; }

void parallelogram_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  vec3 a = corner_a(s);
  vec3 b = corner_b(s);
  vec3 c = corner_c(s);
  vec3 d = corner_d(s);
  lower = vec3(minimum(minimum(a.x, b.x), minimum(c.x, d.x)), minimum(minimum(a.y, b.y), minimum(c.y, d.y)),
               minimum(minimum(a.z, b.z), minimum(c.z, d.z)));
  upper = vec3(maximum(maximum(a.x, b.x), maximum(c.x, d.x)), maximum(maximum(a.y, b.y), maximum(c.y, d.y)),
               maximum(maximum(a.z, b.z), maximum(c.z, d.z)));
}

Surface parallelogram_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = corner_normal(s);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * dot3(n, p - corner_a(s));

  // The edges' dual in the plane.
  vec3 along_u = corner_b(s) - corner_a(s);
  vec3 along_v = corner_c(s) - corner_a(s);
  vec3 across_v = cross3(along_v, n);
  vec3 across_u = cross3(along_u, n);
  float u = dot3(across_v, p - corner_a(s)) / dot3(across_v, along_u);
  float v = dot3(across_u, p - corner_a(s)) / dot3(across_u, along_v);

  // The hit of a ray that grazes the plane may be far beyond an edge.
  p = p + (along_u * (minimum(maximum(u, 0.0f), 1.0f) - u) + along_v * (minimum(maximum(v, 0.0f), 1.0f) - v));

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = inner_uv(vec2(u, v));
  set_gradients(surface, across_v / dot3(across_v, along_u), across_u / dot3(across_u, along_v));
  vec3 reach = abs3(p) + abs3(corner_a(s));
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), reach);
  vec2 inner = inner_step(surface, vec2(u, v), edge_room(ray, max_component(reach), surface.offset));
  surface.inward = along_u * inner.x + along_v * inner.y;
  return surface;
}

SHADER_END
#endif
