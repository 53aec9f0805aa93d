// a, b, c = the origin and the ends of the edges along u and v; their w's are the unit geometric normal.   extra: the fourth corner
#ifndef PARALLELOGRAM_GLSL
#define PARALLELOGRAM_GLSL
#include "geometry/outline.glsl"

SHADER_BEGIN

float parallelogram_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 a = seen_along(ray, vec3(s.a));
  vec3 b = seen_along(ray, vec3(s.b));
  vec3 c = seen_along(ray, vec3(s.c));
  vec3 opposite = vec3(bits_to_floats(load_vertex(s.extra)));
  vec3 d = seen_along(ray, opposite);
  bool inside = (crosses(a, b) != crosses(b, d)) != (crosses(d, c) != crosses(c, a));

  // Far from the eye rounded corners make no parallelogram: the bounds have room for the fourth.
  vec3 n = vec3(s.a.w, s.b.w, s.c.w);
  vec3 from_start = vec3(s.a) - ray.o;
  vec3 along_u = (vec3(s.b) - vec3(s.a)) * 0.5f;
  vec3 along_v = (vec3(s.c) - vec3(s.a)) * 0.5f;
  vec3 skew = abs3((opposite - vec3(s.b)) - (vec3(s.c) - vec3(s.a)));
  float t = t_within(ray, dot3(n, from_start) / dot3(n, ray.d), from_start + (along_u + along_v),
                     abs3(along_u) + abs3(along_v) + skew);
  return inside ? t : -1.0f;
}

bool parallelogram_reject(Primitive s, Ray ray) { return false; }

void parallelogram_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  vec3 d = vec3(bits_to_floats(load_vertex(s.extra)));
  lower = vec3(minimum(minimum(s.a.x, s.b.x), minimum(s.c.x, d.x)), minimum(minimum(s.a.y, s.b.y), minimum(s.c.y, d.y)),
               minimum(minimum(s.a.z, s.b.z), minimum(s.c.z, d.z)));
  upper = vec3(maximum(maximum(s.a.x, s.b.x), maximum(s.c.x, d.x)), maximum(maximum(s.a.y, s.b.y), maximum(s.c.y, d.y)),
               maximum(maximum(s.a.z, s.b.z), maximum(s.c.z, d.z)));
}

Surface parallelogram_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = vec3(s.a.w, s.b.w, s.c.w);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * dot3(n, p - vec3(s.a));

  // The edges' dual in the plane.
  vec3 along_u = vec3(s.b) - vec3(s.a);
  vec3 along_v = vec3(s.c) - vec3(s.a);
  vec3 across_v = cross3(along_v, n);
  vec3 across_u = cross3(along_u, n);
  float u = dot3(across_v, p - vec3(s.a)) / dot3(across_v, along_u);
  float v = dot3(across_u, p - vec3(s.a)) / dot3(across_u, along_v);

  // The hit of a ray that grazes the plane may be far beyond an edge.
  p = p + (along_u * (minimum(maximum(u, 0.0f), 1.0f) - u) + along_v * (minimum(maximum(v, 0.0f), 1.0f) - v));

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = inner_uv(vec2(u, v));
  set_gradients(surface, across_v / dot3(across_v, along_u), across_u / dot3(across_u, along_v));
  vec3 reach = abs3(p) + abs3(vec3(s.a));
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), reach);
  vec2 inner = inner_step(surface, vec2(u, v), edge_room(ray, max_component(reach)));
  surface.inward = along_u * inner.x + along_v * inner.y;
  return surface;
}

SHADER_END
#endif
