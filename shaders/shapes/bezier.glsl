// A piece of the bicubic patch Σ B_i(v)·B_j(u)·p_ij, 0 ≤ u, v ≤ 1. The layer render/ lays out as many as host/shapes/bezier_net.cpp makes.
// extra: the first of 14 vertices: p_00 … p_33, three floats each, u running faster; then the patch's middle, the radius of a ball around it.
// The last one has the least texture coordinates and their growth: those of a lathe are not u and v.
#ifndef BEZIER_GLSL
#define BEZIER_GLSL
#include "shapes/bezier/section.glsl"
#include "geometry/edges.glsl"
#include "records.h"

SHADER_BEGIN

vec4 bezier_span(Primitive s) { return s.a; }  // the piece's u from, to, v from, to
vec3 bezier_middle(Primitive s) { return vec3(s.b); }
float bezier_radius(Primitive s) { return s.b.w; }  // radius of a ball around it
vec3 bezier_normal(Primitive s) { return vec3(s.c); }  // in the middle
float bezier_beyond(Primitive s) { return abs(s.c.w); }  // by which share of its size the search goes beyond its borders; BEZIER_SPECK: none
bool bezier_is_turned(Primitive s) { return s.c.w < 0.0f; }  // the patch's normal is the other one

// Arcs and roots at most (host/shapes/bezier.cpp counts with them), and how short an arc may be, of the whole section.
#define BEZIER_ARCS 24u
#define BEZIER_ROOTS 4u
#define BEZIER_LEAST_ARC 0.00390625f
#define BEZIER_SPECK 2.0f

BezierRow bezier_row(uint first) {
  vec4 a = bits_to_floats(load_vertex(first));
  vec4 b = bits_to_floats(load_vertex(first + 1u));
  vec4 c = bits_to_floats(load_vertex(first + 2u));
  BezierRow row;
  row.p0 = vec3(a);
  row.p1 = vec3(a.w, b.x, b.y);
  row.p2 = vec3(b.z, b.w, c.x);
  row.p3 = vec3(c.y, c.z, c.w);
  return row;
}

vec4 bezier_patch(Primitive s) { return bits_to_floats(load_vertex(s.extra + 12u)); }

// The point p as seen from `o` along three axes.
vec3 bezier_along(vec3 p, vec3 o, vec3 x, vec3 y, vec3 z) {
  vec3 from_o = p - o;
  return vec3(dot3(from_o, x), dot3(from_o, y), dot3(from_o, z));
}
BezierRow bezier_row_along(BezierRow r, vec3 o, vec3 x, vec3 y, vec3 z) {
  BezierRow row;
  row.p0 = bezier_along(r.p0, o, x, y, z);
  row.p1 = bezier_along(r.p1, o, x, y, z);
  row.p2 = bezier_along(r.p2, o, x, y, z);
  row.p3 = bezier_along(r.p3, o, x, y, z);
  return row;
}

// True if the ray comes near the piece.
bool bezier_reject(Primitive s, Ray ray) {
  vec3 to_middle = bezier_middle(s) - ray.o;
  vec3 off = to_middle - ray.d * (dot3(to_middle, ray.d) / dot3(ray.d, ray.d));
  float reach = 1.001f * bezier_radius(s) + 16.0f * EPSILON * (max_component(abs3(to_middle)) + max_component(abs3(ray.o)));
  return !(dot3(off, off) <= reach * reach);
}

void bezier_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  float r = bezier_radius(s);
  vec3 reach = vec3(r, r, r);
  lower = bezier_middle(s) - reach;
  upper = bezier_middle(s) + reach;
}

// t where the piece is within `hair` of the ray near (u, v), else −1; then (u, v) is in the piece.
float bezier_confirm(Primitive s, BezierNet net, BezierRoot root, float hair, OUT(vec2) uv) {
  uv = bezier_within(bezier_span(s), root.uv);
  vec3 p = bezier_at(net, uv.x, uv.y).p;
  return root.found && abs(p.y) <= hair && abs(p.z) <= hair ? p.x : -T_MISS;
}

float bezier_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  // From afar start near the patch, so that nothing cancels (geometry/object_space.glsl).
  uv = vec2(0.0f, 0.0f);
  vec4 patch_ball = bezier_patch(s);
  float speed = sqrt(dot3(ray.d, ray.d));
  vec3 d = ray.d / speed;
  vec3 to_patch = vec3(patch_ball) - ray.o;
  float start = dot3(to_patch, to_patch) > 4.0f * patch_ball.w * patch_ball.w ? dot3(to_patch, d) : 0.0f;
  vec3 o = ray.o + d * start;
  float grain = 8.0f * EPSILON * patch_ball.w;
  float hair = 4.0f * grain + 4.0f * EPSILON * (abs(start) + max_component(abs3(o)));

  // Axes along the section.
  vec3 normal = bezier_normal(s);
  vec3 y = cross3(normal, d);
  float sine = sqrt(dot3(y, y));
  float cosine = dot3(normal, d);
  vec3 other = abs(d.x) < 0.5f ? vec3(0.0f, -d.z, d.y) : vec3(-d.z, 0.0f, d.x);
  y = normalize3(sine > 1.0e-3f ? y : other);
  vec3 z = cross3(d, y);
  BezierNet net;
  net.r0 = bezier_row_along(bezier_row(s.extra), o, d, y, z);
  net.r1 = bezier_row_along(bezier_row(s.extra + 3u), o, d, y, z);
  net.r2 = bezier_row_along(bezier_row(s.extra + 6u), o, d, y, z);
  net.r3 = bezier_row_along(bezier_row(s.extra + 9u), o, d, y, z);

  // Approximate points where the section enters the piece and leaves it, seen from the middle.
  vec4 span = bezier_span(s);
  float beyond = 1.0f + bezier_beyond(s);
  vec2 middle = vec2(0.5f * (span.x + span.y), 0.5f * (span.z + span.w));
  vec2 size = vec2(0.5f * (span.y - span.x) * beyond, 0.5f * (span.w - span.z) * beyond);
  vec3 p = bezier_along(bezier_middle(s), o, d, y, z);
  vec3 tilt = vec3(sine, cosine, sine * p.x - cosine * p.z);
  BezierSection at = bezier_section(net, span, tilt, 0.0f, middle);
  float from_u = (at.uv.x - middle.x) / at.uv_slope.x;
  float from_v = (at.uv.y - middle.y) / at.uv_slope.y;
  float half_u = abs(size.x / at.uv_slope.x);
  float half_v = abs(size.y / at.uv_slope.y);
  float from = maximum(-half_u - from_u, -half_v - from_v);
  float to = minimum(half_u - from_u, half_v - from_v);
  bool speck = bezier_beyond(s) >= BEZIER_SPECK;

  // Go along it in arcs so short that their cubics locate the roots of z, up to the first root that is of this piece and not behind the ray's start.
  bool search = from <= to && !speck && !bezier_reject(s, ray);
  float fine = grain * bezier_radius(s);
  BezierSection near = bezier_settle(net, span, tilt, from, at.uv + at.uv_slope * from, fine, search);
  BezierSection end = bezier_settle(net, span, tilt, to, at.uv + at.uv_slope * to, fine, search);
  BezierSection far = end;
  float least = BEZIER_LEAST_ARC * (to - from);
  float t = -1.0f;
  bool gave_up = false;
  uint roots = 0u;
  for (uint i = 0u; i < BEZIER_ARCS && search && roots < BEZIER_ROOTS; i++) {
    float length = far.w - near.w;
    BezierSection half_way = bezier_settle(net, span, tilt, 0.5f * (near.w + far.w), bezier_between(near, far, 0.5f), fine, true);
    BezierArc arc = bezier_arc(near, far, half_way, grain);
    bool outside = bezier_outside(span, near.uv, half_way.uv, far.uv);
    bool halve = arc.doubted && length > least && !outside;

    float z_0 = bezier_arc_z(arc, arc.turns.x);
    float z_1 = bezier_arc_z(arc, arc.turns.y);
    bool change_0 = (near.z < 0.0f) != (z_0 < 0.0f);
    bool change_1 = (z_0 < 0.0f) != (z_1 < 0.0f);
    bool change_2 = (z_1 < 0.0f) != (far.z < 0.0f);
    vec2 ends = change_0 ? vec2(0.0f, arc.turns.x) : change_1 ? vec2(arc.turns.x, arc.turns.y) : vec2(arc.turns.y, 1.0f);
    vec2 z_ends = change_0 ? vec2(near.z, z_0) : change_1 ? vec2(z_0, z_1) : vec2(z_1, far.z);
    float begin = ends.x + (ends.y - ends.x) * (z_ends.x / (z_ends.x - z_ends.y));
    bool look = !halve && !outside && (change_0 || change_1 || change_2);
    roots += look ? 1u : 0u;
    vec2 bracket = vec2(near.w + length * ends.x, near.w + length * ends.y);
    BezierRoot root = bezier_root(net, span, tilt, bezier_between(near, far, begin), near.w + length * begin, bracket, z_ends, look, grain, bezier_radius(s));
    vec2 there = vec2(0.0f, 0.0f);
    t = start + bezier_confirm(s, net, root, hair, there);
    search = !(t > 0.0f);
    uv = there;
    gave_up = gave_up || (root.gave_up && search);

    // Go on with its first half, with the piece behind the root, or ahead by twice its length.
    bool within = look && ends.y < 1.0f;
    search = search && (halve || within || far.w < end.w);
    BezierSection behind = bezier_on_arc(near, far, arc, ends.y);
    float share = minimum(2.0f * maximum(length, least) / (end.w - far.w), 1.0f);
    bool ahead = search && !halve && !within;
    bool part = share < 1.0f;
    BezierSection next = bezier_settle(net, span, tilt, far.w + share * (end.w - far.w), bezier_between(far, end, share), fine, ahead && part);
    if (within)
      near = behind;
    else if (!halve)
      near = far;
    if (halve)
      far = half_way;
    else if (ahead && part)
      far = next;
    else if (ahead)
      far = end;
  }
  gave_up = gave_up || search;

  // A speck of 2^-12 of the patch, where it comes to a point, is flat, and round.
  if (speck) {
    float along = dot3(normal, bezier_middle(s) - o) / cosine;
    vec3 off = (o + d * along) - bezier_middle(s);
    t = dot3(off, off) <= bezier_radius(s) * bezier_radius(s) ? start + along : -1.0f;
    uv = middle;
  }

  if (gave_up && !(t > 0.0f)) uv = vec2(maximum(start + p.x - bezier_radius(s), 0.0f) / speed, 0.0f);
  return t > 0.0f ? t / speed : gave_up ? T_ITERATION_LIMIT : -1.0f;
}

Surface bezier_surface(Primitive s, Ray ray, Hit hit) {
  vec3 x = vec3(1.0f, 0.0f, 0.0f);
  vec3 y = vec3(0.0f, 1.0f, 0.0f);
  vec3 z = vec3(0.0f, 0.0f, 1.0f);
  vec4 patch_ball = bezier_patch(s);
  vec3 o = vec3(patch_ball);
  BezierNet net;
  net.r0 = bezier_row_along(bezier_row(s.extra), o, x, y, z);
  net.r1 = bezier_row_along(bezier_row(s.extra + 3u), o, x, y, z);
  net.r2 = bezier_row_along(bezier_row(s.extra + 6u), o, x, y, z);
  net.r3 = bezier_row_along(bezier_row(s.extra + 9u), o, x, y, z);
  BezierPoint at = bezier_at(net, hit.uv.x, hit.uv.y);

  // If the derivatives are parallel, or one is 0, as where an edge is one point, the piece's normal is the best approximation.
  vec3 n = cross3(at.du, at.dv);
  float size = dot3(at.du, at.du) + dot3(at.dv, at.dv);
  n = dot3(n, n) > 1.0e-14f * (size * size) ? normalize3(n) : bezier_normal(s);
  Surface surface;
  surface.p = o + at.p;
  surface.normal_geometric = bezier_is_turned(s) ? -n : n;
  surface.normal = surface.normal_geometric;
#if HAS_LATHES
  vec4 field = bits_to_floats(load_vertex(s.extra + 13u));
  surface.uv = inner_uv(vec2(field.x + field.z * hit.uv.x, field.y + field.w * hit.uv.y));
  set_tangents(surface, at.du / field.z, at.dv / field.w);
#else
  surface.uv = inner_uv(hit.uv);
  set_tangents(surface, at.du, at.dv);
#endif
  vec3 reach = abs3(surface.p) + abs3(o);
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), reach) + 48.0f * EPSILON * patch_ball.w;
  vec2 inner = inner_step(surface, hit.uv, edge_room(ray, max_component(reach) + 6.0f * patch_ball.w, surface.offset));
  if (inner.x != 0.0f || inner.y != 0.0f) surface.inward = bezier_at(net, hit.uv.x + inner.x, hit.uv.y + inner.y).p - at.p;
  return surface;
}

SHADER_END
#endif
