// Three corners (geometry/corners.glsl). extra = its corners' normals and so on (records.h), or NONE.
// Parameters of a hit: the weights of the second and third vertex.
#ifndef TRIANGLE_GLSL
#define TRIANGLE_GLSL
#include "geometry/corners.glsl"
#include "geometry/edges.glsl"
#include "records.h"

SHADER_BEGIN

// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013). The edge functions of a shared edge are
// each other's exact negatives, so a ray cannot slip between neighbours; one that hits the edge itself belongs to both.
struct TriangleEdges {
  vec3 x;  // x of the three vertices, from the ray's start, permuted and sheared so that the ray runs along z
  vec3 y;
  vec3 z;
  float u;
  float v;
  float w;
};

TriangleEdges triangle_edges(Primitive s, Ray ray) {
  // Vertex and start are permuted apart, so that it is done once for rays that run together.
  vec3 o = permute(ray.o, ray.major);
  vec3 a = permute(corner_a(s), ray.major) - o;
  vec3 b = permute(corner_b(s), ray.major) - o;
  vec3 c = permute(corner_c(s), ray.major) - o;
  TriangleEdges edges;
  edges.x = vec3(a.x - ray.shear.x * a.z, b.x - ray.shear.x * b.z, c.x - ray.shear.x * c.z);
  edges.y = vec3(a.y - ray.shear.y * a.z, b.y - ray.shear.y * b.z, c.y - ray.shear.y * c.z);
  edges.z = vec3(a.z, b.z, c.z);
  edges.u = edges.x.z * edges.y.y - edges.y.z * edges.x.y;
  edges.v = edges.x.x * edges.y.z - edges.y.x * edges.x.z;
  edges.w = edges.x.y * edges.y.x - edges.y.y * edges.x.x;
  return edges;
}

bool triangle_inside(TriangleEdges edges) {
  return minimum(edges.u, minimum(edges.v, edges.w)) >= 0.0f || maximum(edges.u, maximum(edges.v, edges.w)) <= 0.0f;
}

// The delay of a ray at a triangle near an edge, relative to t. If both neighbours of an edge are on the same side of it, as the ray sees
// them, it must hit the nearer one: the other one may lead out of a room. Rounding would decide that close to the edge. So t is up to 24
// roundings more or less there, as the triangle leads away from the ray's start beside the edge, or towards it. `facing`: n · d.
float edge_delay(TriangleEdges edges, vec3 n, float facing) {
  vec3 f = abs3(vec3(edges.u, edges.v, edges.w));
  float nearest = minimum(f.x, minimum(f.y, f.z));
  float size = maximum(max_component(abs3(edges.x)), max_component(abs3(edges.y)));
  float delay = 0.0f;
  if (nearest <= 64.0f * EPSILON * size * max_component(abs3(edges.z))) {
    bool at_u = f.x == nearest;
    bool at_v = f.y == nearest;
    float along_x = at_u ? edges.x.z - edges.x.y : at_v ? edges.x.x - edges.x.z : edges.x.y - edges.x.x;
    float along_y = at_u ? edges.y.z - edges.y.y : at_v ? edges.y.x - edges.y.z : edges.y.y - edges.y.x;
    float leads = n.y * along_x - n.x * along_y;
    leads = ((edges.u + edges.v) + edges.w < 0.0f) == (facing < 0.0f) ? leads : -leads;
    float whole = abs(leads) + (abs(along_x) + abs(along_y)) * abs(facing);
    delay = whole > 0.0f ? 24.0f * EPSILON * leads / whole : 0.0f;
  }
  return delay;
}

// The t of the hit, if the edge functions are all "inside".
// There, the triangle is its plane. Near the plane, and for slivers, this is far more exact than the weighted mean of the vertices'
// distances. A ray that starts off the plane on the far side has t ≤ 0 for certain. But along a ray that grazes the plane, t may
// come out anywhere, and where products round to the same, edges reach far past their ends. A BVH would miss brute force's hits
// there. So the triangle is cut by a plane through the ray and the x or y axis. A ray that has all vertices on one side of it misses,
// for a product never rounds past another, and else t is brought to between the two points where edges cross it. Every hit then lies
// on the triangle, up to a few roundings of the farthest point along the ray: within the box of any part that the triangle may be cut
// into. Of the two planes it is the one less along the triangle's own. The other one separates the vertices too: were they all on one side, two edge
// functions would be sums of terms of one sign, a different one each.
float triangle_t(Primitive s, Ray ray, TriangleEdges edges) {
  vec3 n = corner_normal(s);
  float facing = dot3(n, ray.d);
  float t = dot3(n, corner_a(s) - ray.o) / facing;
  vec3 across = permute(n, ray.major);
  float delay = edge_delay(edges, across, facing);
  vec3 steep = abs3(across);
  vec3 side = steep.x < steep.y ? edges.x : edges.y;

  // One vertex is alone on its side. Vertices that lie in the plane count to the side that has no others.
  float least = minimum(side.x, minimum(side.y, side.z));
  bool passes = least <= 0.0f && maximum(side.x, maximum(side.y, side.z)) >= 0.0f;
  bool low_a = side.x < 0.0f || side.x <= least;
  bool low_b = side.y < 0.0f || side.y <= least;
  bool low_c = side.z < 0.0f || side.z <= least;
  bool a_is_alone = low_b == low_c;
  bool c_is_alone = low_a == low_b;
  vec2 alone = c_is_alone ? vec2(side.z, edges.z.z) : a_is_alone ? vec2(side.x, edges.z.x) : vec2(side.y, edges.z.y);
  vec2 p = a_is_alone && !c_is_alone ? vec2(side.y, edges.z.y) : vec2(side.x, edges.z.x);
  vec2 q = c_is_alone ? vec2(side.y, edges.z.y) : vec2(side.z, edges.z.z);

  float inverse = permute(ray.inverse, ray.major).z;
  float along_p = (alone.y + (p.y - alone.y) * (alone.x / (alone.x - p.x))) * inverse;
  float along_q = (alone.y + (q.y - alone.y) * (alone.x / (alone.x - q.x))) * inverse;
  t = passes && t > 0.0f ? minimum(maximum(t, minimum(along_p, along_q)), maximum(along_p, along_q)) : -1.0f;

  return t + t * delay;
}

float triangle_intersect_woop(Primitive s, Ray ray, OUT(vec2) uv) {
  TriangleEdges edges = triangle_edges(s, ray);
  float det = (edges.u + edges.v) + edges.w;
  float inverse = 1.0f / det;
  uv = vec2(edges.v * inverse, edges.w * inverse);
  return triangle_inside(edges) && det != 0.0f ? triangle_t(s, ray, edges) : -1.0f;
}

// Möller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection" (1997), without its epsilon. Not watertight: kept for
// comparison, `--triangle moller-trumbore`.
float triangle_intersect_moller_trumbore(Primitive s, Ray ray, OUT(vec2) uv) {
  vec3 e1 = corner_b(s) - corner_a(s);
  vec3 e2 = corner_c(s) - corner_a(s);
  vec3 p = cross3(ray.d, e2);
  float det = dot3(e1, p);
  vec3 f = ray.o - corner_a(s);
  uv = vec2(dot3(f, p) / det, dot3(ray.d, cross3(f, e1)) / det);
  bool inside = uv.x >= 0.0f && uv.y >= 0.0f && uv.x + uv.y <= 1.0f;
  TriangleEdges edges = triangle_edges(s, ray);
  return inside && triangle_inside(edges) && (edges.u + edges.v) + edges.w != 0.0f ? triangle_t(s, ray, edges) : -1.0f;
}

float triangle_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  if (TRIANGLE_METHOD == TRIANGLE_MOLLER_TRUMBORE) return triangle_intersect_moller_trumbore(s, ray, uv);
  return triangle_intersect_woop(s, ray, uv);
}

bool triangle_reject(Primitive s, Ray ray) {
  return TRIANGLE_METHOD != TRIANGLE_MOLLER_TRUMBORE && !triangle_inside(triangle_edges(s, ray));
}

void triangle_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  vec3 a = corner_a(s);
  vec3 b = corner_b(s);
  vec3 c = corner_c(s);
  lower = vec3(minimum(a.x, minimum(b.x, c.x)), minimum(a.y, minimum(b.y, c.y)), minimum(a.z, minimum(b.z, c.z)));
  upper = vec3(maximum(a.x, maximum(b.x, c.x)), maximum(a.y, maximum(b.y, c.y)), maximum(a.z, maximum(b.z, c.z)));
}

// From the point with those weights to the inside of the edges. A weight is 0 at its edge and grows by 1 over the triangle's height there.
vec3 triangle_inward(Primitive s, vec3 weights, float room) {
  vec3 ab = corner_b(s) - corner_a(s);
  vec3 bc = corner_c(s) - corner_b(s);
  vec3 ca = corner_a(s) - corner_c(s);
  vec3 across = cross3(ab, ca);
  float per_height = room / sqrt(dot3(across, across));
  vec3 edges = vec3(sqrt(dot3(bc, bc)), sqrt(dot3(ca, ca)), sqrt(dot3(ab, ab)));
  vec3 missing = vec3(minimum(edges.x * per_height, 0.25f), minimum(edges.y * per_height, 0.25f), minimum(edges.z * per_height, 0.25f)) - weights;

  // Away from the edge that is farthest too near, perpendicular to it; or as askew as the two other edges need. The missing weights are that
  // edge's and those of the next two.
  vec3 distance = missing / edges;
  bool first = distance.x >= distance.y && distance.x >= distance.z;
  bool second = !first && distance.y >= distance.z;
  vec3 m = first ? missing : second ? vec3(missing.y, missing.z, missing.x) : vec3(missing.z, missing.x, missing.y);
  vec3 up = first ? ca : second ? ab : bc;
  vec3 along = first ? -bc : second ? -ca : -ab;
  float rise = maximum(m.x, 0.0f);
  float slide = -rise * dot3(up, along) / dot3(along, along);
  return up * rise + along * minimum(maximum(slide, m.y), -m.z - rise);
}

// The index, in vec4, of the values that a vertex has behind its normal, u and colour.
uint beside_normal(uvec4 corners) { return (corners.w & CORNERS_COLORS) != 0u ? 2u : 1u; }

Surface triangle_surface(Primitive s, Ray ray, Hit hit) {
  float wa = (1.0f - hit.uv.x) - hit.uv.y;
  vec3 a = corner_a(s) * wa;
  vec3 b = corner_b(s) * hit.uv.x;
  vec3 c = corner_c(s) * hit.uv.y;

  Surface surface;
  surface.p = (a + b) + c;
  surface.normal_geometric = corner_normal(s);
  surface.normal = surface.normal_geometric;
  surface.uv = hit.uv;
  set_gradients(surface, vec3(0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 0.0f));
  if (s.extra != NONE) {
    uvec4 corners = load_vertex(s.extra);
    vec4 n0 = bits_to_floats(load_vertex(corners.x));
    vec4 n1 = bits_to_floats(load_vertex(corners.y));
    vec4 n2 = bits_to_floats(load_vertex(corners.z));
    if ((corners.w & CORNERS_NORMALS) != 0u)
      surface.normal = normalize3((vec3(n0) * wa + vec3(n1) * hit.uv.x) + vec3(n2) * hit.uv.y);
    if ((corners.w & CORNERS_UV) != 0u) {
      vec4 v = bits_to_floats(load_vertex(s.extra + 1u));
      surface.uv = vec2((n0.w * wa + n1.w * hit.uv.x) + n2.w * hit.uv.y,
                        (v.x * wa + v.y * hit.uv.x) + v.z * hit.uv.y);
    }
#if HAS_BENT_NORMALS
    uint beside = beside_normal(corners);
    uint gradients = s.extra + ((corners.w & CORNERS_UV) != 0u ? 2u : 1u);
    if ((corners.w & CORNERS_GRADIENTS) != 0u)
      set_gradients(surface, vec3(bits_to_floats(load_vertex(gradients))), vec3(bits_to_floats(load_vertex(gradients + 1u))));
#if HAS_SECOND_UV
    bool second = (corners.w & CORNERS_SECOND_UV) != 0u;
    if ((corners.w & CORNERS_GRADIENTS) != 0u && second) {
      surface.second_u_gradient = vec3(bits_to_floats(load_vertex(gradients + 2u)));
      surface.second_v_gradient = vec3(bits_to_floats(load_vertex(gradients + 3u)));
    }
    beside = second ? beside + 1u : beside;
#endif
    if ((corners.w & CORNERS_TANGENTS) != 0u) {
      vec4 t0 = bits_to_floats(load_vertex(corners.x + beside));
      vec4 t1 = bits_to_floats(load_vertex(corners.y + beside));
      vec4 t2 = bits_to_floats(load_vertex(corners.z + beside));
      surface.tangent = (t0 * wa + t1 * hit.uv.x) + t2 * hit.uv.y;
      surface.tangent.w = t0.w;
#if HAS_SECOND_UV
      bool along_second = (corners.w & CORNERS_SECOND_TANGENTS) != 0u;
      vec4 none = vec4(0.0f, 0.0f, 0.0f, 0.0f);
      surface.second_tangent = along_second || !second ? surface.tangent : none;
      surface.tangent = along_second ? none : surface.tangent;
#endif
    }
#endif
  }
  vec3 reach = abs3(corner_a(s)) + abs3(corner_b(s)) + abs3(corner_c(s));
  surface.offset = 8.0f * EPSILON * dot3(abs3(surface.normal_geometric), reach);
  surface.inward = triangle_inward(s, vec3(wa, hit.uv.x, hit.uv.y), edge_room(ray, max_component(reach), surface.offset));
  return surface;
}

#if HAS_SECOND_UV
// The second texture coordinates of a mesh's vertices; `uv` where they have none, and on other shapes.
vec2 second_uv(Primitive s, Hit hit, vec2 uv) {
  if (kind_of(s) != KIND_triangle || s.extra == NONE) return uv;
  uvec4 corners = load_vertex(s.extra);
  if ((corners.w & CORNERS_SECOND_UV) == 0u) return uv;
  uint beside = beside_normal(corners);
  vec4 a = bits_to_floats(load_vertex(corners.x + beside));
  vec4 b = bits_to_floats(load_vertex(corners.y + beside));
  vec4 c = bits_to_floats(load_vertex(corners.z + beside));
  float wa = (1.0f - hit.uv.x) - hit.uv.y;
  return vec2((a.x * wa + b.x * hit.uv.x) + c.x * hit.uv.y, (a.y * wa + b.y * hit.uv.x) + c.y * hit.uv.y);
}
#endif

SHADER_END
#endif
