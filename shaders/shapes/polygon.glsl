// extra: U, U0 and V, V0 (u = U·x + U0, v = V·x + V0), then a path: a vertex, and four more an iteration. The path runs around the outline, then
// for each hole over to it, around it, and back. It returns on the same way, so that the two cancel to the last bit. After its end it stays there.
// The polygon is to the left of its edges, seen from where the normal points. A vertex's w is 1 if an edge leads to it, 0 if the way does.
#ifndef POLYGON_GLSL
#define POLYGON_GLSL
#include "geometry/outline.glsl"

SHADER_BEGIN

vec3 polygon_normal(Primitive s) { return vec3(s.a); }
uint polygon_turns(Primitive s) { return uint(s.a.w); }  // iterations of the loop below
vec3 polygon_center(Primitive s) { return vec3(s.b); }  // center of the bounds, on the plane
vec3 polygon_half_size(Primitive s) { return vec3(s.c); }

vec3 path_vertex(Ray ray, uint i) { return seen_along(ray, vec3(bits_to_floats(load_outline(i)))); }

// t, brought to the polygon's nearest edge if no part of the polygon is there. The polygon is cut, as in shapes/triangle.glsl, by the plane through
// the ray and the sheared x or y axis, whichever is less along the polygon's plane. The ray is within where it has passed an odd number of edges.
float t_between_edges(Primitive s, Ray ray, float t, uint at, uint end) {
  vec3 steep = permute(abs3(polygon_normal(s)), ray.major);
  bool across_x = steep.x < steep.y;
  float inverse = permute(ray.inverse, ray.major).z;
  bool within = false;
  float below = -T_MISS;
  float above = T_MISS;
  vec3 a = path_vertex(ray, at);
  for (; at < end; at++) {
    vec4 next = bits_to_floats(load_outline(at + 1u));
    vec3 b = seen_along(ray, vec3(next));
    float from = across_x ? a.x : a.y;
    float to = across_x ? b.x : b.y;
    if (next.w != 0.0f && (from > 0.0f) != (to > 0.0f)) {
      float crossing = (a.z + (b.z - a.z) * (from / (from - to))) * inverse;
      bool passed = crossing < t;
      within = within != passed;
      below = passed ? maximum(below, crossing) : below;
      above = passed ? above : minimum(above, crossing);
    }
    a = b;
  }
  return within ? t : t - below < above - t ? below : above;
}

// Only a ray within the bounds enters the loop: a ray beside the polygon costs no iteration.
float polygon_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 n = polygon_normal(s);
  vec3 centre = polygon_center(s) - ray.o;
  float t = t_within(ray, dot3(n, centre) / dot3(n, ray.d), centre, polygon_half_size(s));
  uint at = s.extra + 2u;
  uint end = t > 0.0f ? at + 4u * polygon_turns(s) : at;
  vec3 a = path_vertex(ray, at);
  bool inside = false;
  // Tested at the bottom, which saves an iteration with all lanes idle: a choice around loads keeps the results for the rays that are done
  // (docs/lavapipe.md).
  do {
    if (at < end) {
      vec3 b = path_vertex(ray, at + 1u);
      vec3 c = path_vertex(ray, at + 2u);
      vec3 d = path_vertex(ray, at + 3u);
      vec3 e = path_vertex(ray, at + 4u);
      inside = inside != ((crosses(a, b) != crosses(b, c)) != (crosses(c, d) != crosses(d, e)));
      a = e;
    }
    at += 4u;
  } while (at < end);

  // Along a ray that grazes the plane, t may be off by more than rays start inside of edges (geometry/edges.glsl).
  float slope = dot3(n, ray.d);
  if (inside && slope * slope < 0.00390625f * dot3(ray.d, ray.d)) t = t_between_edges(s, ray, t, s.extra + 2u, end);
  return inside && t > 0.0f ? t : -1.0f;
}

bool polygon_reject(Primitive s, Ray ray) { return false; }

void polygon_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = polygon_center(s) - polygon_half_size(s);
  upper = polygon_center(s) + polygon_half_size(s);
}

// From p to the inside of the edges. Twice: at a sharp corner the step away from an edge may lead closer to one before it.
vec3 polygon_inward(Primitive s, vec3 p, float room) {
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  uint at = s.extra + 2u;
  uint steps = 4u * polygon_turns(s);
  vec3 first = vec3(bits_to_floats(load_outline(at)));
  vec3 a = first;
  for (uint i = 0u; i < 2u * steps; i++) {
    vec4 next = bits_to_floats(load_outline(at + 1u + (i < steps ? i : i - steps)));
    vec3 b = vec3(next);
    a = i == steps ? first : a;
    vec3 along = b - a;
    float squared = dot3(along, along);
    vec3 outward = cross3(along, polygon_normal(s));
    float share = dot3(along, p + inward - a);
    float beyond = room * sqrt(squared);
    float value = dot3(outward, p - a);
    if (next.w != 0.0f && abs(value) < 2.0f * beyond && share > -beyond && share < squared + beyond)
      inward = inward_of_face(inward, polygon_normal(s), value, outward, room);
    a = b;
  }
  return inward;
}

Surface polygon_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = polygon_normal(s);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * dot3(n, p - polygon_center(s));
  vec4 u = bits_to_floats(load_vertex(s.extra));
  vec4 v = bits_to_floats(load_vertex(s.extra + 1u));

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = vec2(dot3(vec3(u), p) + u.w, dot3(vec3(v), p) + v.w);
  set_gradients(surface, vec3(u), vec3(v));
  vec3 reach = abs3(p) + abs3(polygon_center(s));
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), reach);
  surface.inward = polygon_inward(s, p, edge_room(ray, max_component(reach + polygon_half_size(s)), surface.offset));
  return surface;
}

SHADER_END
#endif
