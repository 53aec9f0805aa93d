// (1 − u)(1 − v)·p00 + u(1 − v)·p10 + (1 − u)v·p01 + uv·p11, 0 ≤ u, v ≤ 1.   extra: 1 where the normal is the other one
#ifndef BILINEAR_GLSL
#define BILINEAR_GLSL
#include "geometry/edges.glsl"
#include "records.h"

SHADER_BEGIN

vec3 bilinear_p00(Primitive s) { return vec3(s.a); }
vec3 bilinear_p10(Primitive s) { return vec3(s.b); }
vec3 bilinear_p01(Primitive s) { return vec3(s.c); }
vec3 bilinear_p11(Primitive s) { return vec3(s.a.w, s.b.w, s.c.w); }

// The point where the line v ↦ p + v·edge comes nearest to the ray o = 0, d: t, or −1 if it is not between the line's
// ends; and v.
vec2 intersect_ruling(vec3 p, vec3 edge, vec3 d) {
  vec3 across = cross3(d, edge);
  float square = dot3(across, across);
  vec3 n = cross3(across, p);
  float v = dot3(n, d) / square;
  float t = dot3(n, edge) / square;
  return v >= 0.0f && v <= 1.0f ? vec2(t, v) : vec2(-T_MISS, v);
}

float bilinear_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  vec3 p11 = bilinear_p11(s);
  vec3 p00 = bilinear_p00(s);
  vec3 p10 = bilinear_p10(s);
  vec3 p01 = bilinear_p01(s);

  // From afar start near the middle, so that nothing cancels (geometry/object_space.glsl).
  vec3 middle = ((p00 + p11) + (p10 + p01)) * 0.25f;
  vec3 reach = (abs3(p00 - middle) + abs3(p11 - middle)) + (abs3(p10 - middle) + abs3(p01 - middle));
  vec3 to_middle = middle - ray.o;
  float square = dot3(ray.d, ray.d);
  bool afar = dot3(to_middle, to_middle) > 4.0f * dot3(reach, reach);
  float start = afar ? dot3(to_middle, ray.d) / square : 0.0f;
  vec3 o = ray.o + ray.d * start;
  p00 = p00 - o;
  p10 = p10 - o;
  p01 = p01 - o;
  p11 = p11 - o;

  // The volume between the ray and the ruling at u is 0 where they intersect: a + b·u + c·u² = 0.
  vec3 left = p01 - p00;
  vec3 right = p11 - p10;
  vec3 twist = right - left;
  vec3 d = ray.d / sqrt(square);
  float a = dot3(cross3(p00, d), left);
  float c = dot3(cross3(p10 - p00, d), twist);
  float b = dot3(cross3(p10 - p00, d), left) + dot3(cross3(p00, d), twist);
  float discriminant = b * b - 4.0f * a * c;
  float root = sqrt(maximum(discriminant, 0.0f));
  float q = -0.5f * (b < 0.0f ? b - root : b + root);
  float u0 = q / c;
  float u1 = a / q;

  vec2 first = intersect_ruling(p00 + (p10 - p00) * u0, left + twist * u0, ray.d);
  vec2 second = intersect_ruling(p00 + (p10 - p00) * u1, left + twist * u1, ray.d);
  float t0 = discriminant >= 0.0f && u0 >= 0.0f && u0 <= 1.0f ? start + first.x : -1.0f;
  float t1 = discriminant >= 0.0f && u1 >= 0.0f && u1 <= 1.0f ? start + second.x : -1.0f;
  bool take_first = t0 > 0.0f && (t0 < t1 || !(t1 > 0.0f));
  uv = take_first ? vec2(u0, first.y) : vec2(u1, second.y);
  return take_first ? t0 : t1;
}

bool bilinear_reject(Primitive s, Ray ray) { return false; }

void bilinear_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  vec3 a = bilinear_p00(s);
  vec3 b = bilinear_p10(s);
  vec3 c = bilinear_p01(s);
  vec3 d = bilinear_p11(s);
  lower = vec3(minimum(minimum(a.x, b.x), minimum(c.x, d.x)), minimum(minimum(a.y, b.y), minimum(c.y, d.y)),
               minimum(minimum(a.z, b.z), minimum(c.z, d.z)));
  upper = vec3(maximum(maximum(a.x, b.x), maximum(c.x, d.x)), maximum(maximum(a.y, b.y), maximum(c.y, d.y)),
               maximum(maximum(a.z, b.z), maximum(c.z, d.z)));
}

Surface bilinear_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p00 = bilinear_p00(s);
  vec3 along_u = bilinear_p10(s) - p00;
  vec3 left = bilinear_p01(s) - p00;
  vec3 right = bilinear_p11(s) - bilinear_p10(s);
  vec3 along_v = left + (right - left) * hit.uv.x;
  vec3 across_v = along_u + (right - left) * hit.uv.y;
  vec3 n = cross3(across_v, along_v);

  Surface surface;
  surface.p = (p00 + along_u * hit.uv.x) + along_v * hit.uv.y;
  surface.normal_geometric = normalize3(s.extra == 1u ? -n : n);
  surface.normal = surface.normal_geometric;
  surface.uv = inner_uv(hit.uv);
  vec3 reach = (abs3(p00) + abs3(bilinear_p10(s))) + (abs3(bilinear_p01(s)) + abs3(bilinear_p11(s)));
  set_tangents(surface, across_v, along_v);
  surface.offset = 48.0f * EPSILON * dot3(abs3(surface.normal_geometric), reach);
  vec2 inner = inner_step(surface, hit.uv, edge_room(ray, 6.0f * max_component(reach), surface.offset));
  surface.inward = (across_v * inner.x + along_v * inner.y) + (right - left) * (inner.x * inner.y);
  return surface;
}

SHADER_END
#endif
