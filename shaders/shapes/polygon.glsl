// a = unit normal, turns of the loop below    b = centre of the bounds, on the plane    c = half of their size
// extra: U, U0 and V, V0 (u = U·x + U0, v = V·x + V0), then a path: a vertex, and four more a turn.
// The path runs round the outline, then for each hole over to it, round it, and back. It comes back on the way that it went over, so
// that the two cancel to the last bit. Where it is done it stays.
#ifndef POLYGON_GLSL
#define POLYGON_GLSL
#include "geometry/outline.glsl"

SHADER_BEGIN

vec3 path_vertex(Ray ray, uint i) { return seen_along(ray, vec3(bits_to_floats(load_outline(i)))); }

// Only a ray that passes the bounds goes round: what is beside the polygon costs no turn.
float polygon_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 n = vec3(s.a);
  vec3 centre = vec3(s.b) - ray.o;
  float t = t_within(ray, dot3(n, centre) / dot3(n, ray.d), centre, vec3(s.c));
  uint at = s.extra + 2u;
  uint end = t > 0.0f ? at + 4u * uint(s.a.w) : at;
  vec3 a = path_vertex(ray, at);
  bool inside = false;
  // Tested at the bottom, which saves a turn with all lanes idle: a choice around loads keeps what came out for the rays that are done
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
  return inside ? t : -1.0f;
}

bool polygon_reject(Primitive s, Ray ray) { return false; }

void polygon_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = vec3(s.b) - vec3(s.c);
  upper = vec3(s.b) + vec3(s.c);
}

Surface polygon_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = vec3(s.a);
  vec3 p = ray.o + ray.d * hit.t;
  p = p - n * dot3(n, p - vec3(s.b));
  vec4 u = bits_to_floats(load_vertex(s.extra));
  vec4 v = bits_to_floats(load_vertex(s.extra + 1u));

  Surface surface;
  surface.p = p;
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = vec2(dot3(vec3(u), p) + u.w, dot3(vec3(v), p) + v.w);
  set_gradients(surface, vec3(u), vec3(v));
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), abs3(p) + abs3(vec3(s.b)));
  return surface;
}

SHADER_END
#endif
