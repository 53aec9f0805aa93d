// a, b, c = the vertices; their w's are the unit geometric normal, from float64. extra = its corners (records.h), or NONE.
// Parameters of a hit: the weights of the second and third vertex.
#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL
#include "ray.glsl"
#include "records.h"

SHADER_BEGIN

// Along the ray, the triangle is its plane: near the plane, and for slivers, this is far more exact than the weighted mean of the
// vertices' distances, and a ray that starts off the plane on the far side has t ≤ 0 for certain.
// But along a ray that grazes the plane, t may come out anywhere, and where products round to the same, a needle's edges reach far past
// its ends. A tree would miss what brute force finds there. So a hit must be within the triangle's own bounds, and t is brought into
// them. Whatever rounding lets a ray hit is within them up to `room`, along each axis: 16 roundings of the largest coordinate along
// the ray, a quarter of what tree.glsl widens its boxes by. a, b, c: the vertices from the ray's start, permuted.
float triangle_t(Primitive s, Ray ray, vec3 a, vec3 b, vec3 c) {
  vec3 n = vec3(s.a.w, s.b.w, s.c.w);
  float t = dot3(n, vec3(s.a) - ray.o) / dot3(n, ray.d);
  vec3 inverse = permute(ray.inverse, ray.major);
  vec3 ta = a * inverse;
  vec3 tb = b * inverse;
  vec3 tc = c * inverse;
  vec3 room = abs3(inverse) * (16.0f * EPSILON * maximum(abs(a.z), maximum(abs(b.z), abs(c.z))));
  vec3 nearest = vec3(minimum(ta.x, minimum(tb.x, tc.x)), minimum(ta.y, minimum(tb.y, tc.y)), minimum(ta.z, minimum(tb.z, tc.z)));
  vec3 farthest = vec3(maximum(ta.x, maximum(tb.x, tc.x)), maximum(ta.y, maximum(tb.y, tc.y)), maximum(ta.z, maximum(tb.z, tc.z)));
  float entry = max_component(nearest - room);
  float exit = -max_component(-farthest - room);
  return t > 0.0f && entry <= exit ? minimum(maximum(t, entry), exit) : -1.0f;
}

// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013). The edge functions of a shared edge are
// each other's exact negatives, so a ray cannot slip between neighbours; one that hits the edge itself belongs to both.
struct TriangleEdges {
  vec3 a;  // the vertices from the ray's start, permuted
  vec3 b;
  vec3 c;
  float u;
  float v;
  float w;
};

TriangleEdges triangle_edges(Primitive s, Ray ray) {
  // Vertex and start are permuted apart, so that it is done once for rays that run together.
  vec3 o = permute(ray.o, ray.major);
  TriangleEdges edges;
  edges.a = permute(vec3(s.a), ray.major) - o;
  edges.b = permute(vec3(s.b), ray.major) - o;
  edges.c = permute(vec3(s.c), ray.major) - o;
  float ax = edges.a.x - ray.shear.x * edges.a.z;
  float ay = edges.a.y - ray.shear.y * edges.a.z;
  float bx = edges.b.x - ray.shear.x * edges.b.z;
  float by = edges.b.y - ray.shear.y * edges.b.z;
  float cx = edges.c.x - ray.shear.x * edges.c.z;
  float cy = edges.c.y - ray.shear.y * edges.c.z;
  edges.u = cx * by - cy * bx;
  edges.v = ax * cy - ay * cx;
  edges.w = bx * ay - by * ax;
  return edges;
}

bool triangle_inside(TriangleEdges edges) {
  return minimum(edges.u, minimum(edges.v, edges.w)) >= 0.0f || maximum(edges.u, maximum(edges.v, edges.w)) <= 0.0f;
}

float triangle_intersect_woop(Primitive s, Ray ray, OUT(vec2) uv) {
  TriangleEdges edges = triangle_edges(s, ray);
  float det = (edges.u + edges.v) + edges.w;
  float inverse = 1.0f / det;
  uv = vec2(edges.v * inverse, edges.w * inverse);
  return triangle_inside(edges) && det != 0.0f ? triangle_t(s, ray, edges.a, edges.b, edges.c) : -1.0f;
}

// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), without its epsilon. Not watertight: kept for
// comparison, `--triangle moller-trumbore`.
float triangle_intersect_moller_trumbore(Primitive s, Ray ray, OUT(vec2) uv) {
  vec3 e1 = vec3(s.b) - vec3(s.a);
  vec3 e2 = vec3(s.c) - vec3(s.a);
  vec3 p = cross3(ray.d, e2);
  float det = dot3(e1, p);
  vec3 f = ray.o - vec3(s.a);
  uv = vec2(dot3(f, p) / det, dot3(ray.d, cross3(f, e1)) / det);
  bool inside = uv.x >= 0.0f && uv.y >= 0.0f && uv.x + uv.y <= 1.0f;
  return inside ? triangle_t(s, ray, permute(vec3(s.a) - ray.o, ray.major), permute(vec3(s.b) - ray.o, ray.major),
                             permute(vec3(s.c) - ray.o, ray.major))
                : -1.0f;
}

float triangle_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  if (TRIANGLE_METHOD == TRIANGLE_MOLLER_TRUMBORE) return triangle_intersect_moller_trumbore(s, ray, uv);
  return triangle_intersect_woop(s, ray, uv);
}

bool triangle_may_hit(Primitive s, Ray ray) {
  return TRIANGLE_METHOD == TRIANGLE_MOLLER_TRUMBORE || triangle_inside(triangle_edges(s, ray));
}

void triangle_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = vec3(minimum(s.a.x, minimum(s.b.x, s.c.x)), minimum(s.a.y, minimum(s.b.y, s.c.y)), minimum(s.a.z, minimum(s.b.z, s.c.z)));
  upper = vec3(maximum(s.a.x, maximum(s.b.x, s.c.x)), maximum(s.a.y, maximum(s.b.y, s.c.y)), maximum(s.a.z, maximum(s.b.z, s.c.z)));
}

Surface triangle_surface(Primitive s, Ray ray, Hit hit) {
  float wa = (1.0f - hit.uv.x) - hit.uv.y;
  vec3 a = vec3(s.a) * wa;
  vec3 b = vec3(s.b) * hit.uv.x;
  vec3 c = vec3(s.c) * hit.uv.y;

  Surface surface;
  surface.p = (a + b) + c;
  surface.normal_geometric = vec3(s.a.w, s.b.w, s.c.w);
  surface.normal = surface.normal_geometric;
  surface.uv = hit.uv;
  if (s.head.w != NONE) {
    uvec4 corners = load_vertex(s.head.w);
    vec4 n0 = bits_to_floats(load_vertex(corners.x));
    vec4 n1 = bits_to_floats(load_vertex(corners.y));
    vec4 n2 = bits_to_floats(load_vertex(corners.z));
    if ((corners.w & CORNERS_NORMALS) != 0u) {
      vec3 normal = normalize3((vec3(n0) * wa + vec3(n1) * hit.uv.x) + vec3(n2) * hit.uv.y);
      surface.normal = dot3(normal, surface.normal_geometric) > 0.0f ? normal : surface.normal_geometric;
    }
    if ((corners.w & CORNERS_UV) != 0u) {
      vec4 v = bits_to_floats(load_vertex(s.head.w + 1u));
      surface.uv = vec2((n0.w * wa + n1.w * hit.uv.x) + n2.w * hit.uv.y,
                        (v.x * wa + v.y * hit.uv.x) + v.z * hit.uv.y);
    }
  }
  vec3 reach = abs3(vec3(s.a)) + abs3(vec3(s.b)) + abs3(vec3(s.c));
  surface.offset = 8.0f * EPSILON * dot3(abs3(surface.normal_geometric), reach);
  return surface;
}

#if HAS_COLORS
// What a mesh's vertices multiply the material's colour by; white where they say nothing, and on other shapes.
vec3 vertex_color(Primitive s, Hit hit) {
  if (kind_of(s) != KIND_triangle || s.head.w == NONE) return vec3(1.0f, 1.0f, 1.0f);
  uvec4 corners = load_vertex(s.head.w);
  if ((corners.w & CORNERS_COLORS) == 0u) return vec3(1.0f, 1.0f, 1.0f);
  vec3 a = vec3(bits_to_floats(load_vertex(corners.x + 1u)));
  vec3 b = vec3(bits_to_floats(load_vertex(corners.y + 1u)));
  vec3 c = vec3(bits_to_floats(load_vertex(corners.z + 1u)));
  return (a * ((1.0f - hit.uv.x) - hit.uv.y) + b * hit.uv.x) + c * hit.uv.y;
}
#endif

SHADER_END
#endif
