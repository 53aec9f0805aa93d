// A piece of the bicubic patch Σ B_i(v)·B_j(u)·p_ij, 0 ≤ u, v ≤ 1; render/ lays out as many as host/shapes/bezier_pieces.cpp makes.
//   a = the piece's u from, to, v from, to
//   b = its middle, the radius of a ball around it
//   c = its normal there, by which share of its size the search goes beyond its borders, BEZIER_SPECK: there is no search; below 0 where the
//       patch's normal is the other one
//   extra = the first of 13 vertices: p_00 … p_33, three floats each, u running faster; then the patch's middle, the radius of a ball around it
#ifndef BEZIER_GLSL
#define BEZIER_GLSL
#include "ray.glsl"
#include "records.h"

SHADER_BEGIN

#define BEZIER_STEPS 40u
#define BEZIER_SPECK 2.0f

struct BezierRow {
  vec3 p0;
  vec3 p1;
  vec3 p2;
  vec3 p3;
};

struct BezierNet {
  BezierRow r0;
  BezierRow r1;
  BezierRow r2;
  BezierRow r3;
};

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

vec4 bezier_patch(Primitive s) { return bits_to_floats(load_vertex(s.head.w + 12u)); }

// Seen from `o` along three axes.
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

// A point of the surface and its derivatives.
struct BezierPoint {
  vec3 p;
  vec3 du;
  vec3 dv;
};

vec4 bezier_weights(float t) {
  float s = 1.0f - t;
  return vec4(s * s * s, 3.0f * (s * s) * t, 3.0f * s * (t * t), t * t * t);
}
vec3 bezier_sum(vec3 a, vec3 b, vec3 c, vec3 d, vec4 w) { return (a * w.x + b * w.y) + (c * w.z + d * w.w); }
// From differences of the points: where they are one, the derivative is 0.
vec3 bezier_slope(vec3 a, vec3 b, vec3 c, vec3 d, float t) {
  float s = 1.0f - t;
  return ((b - a) * (s * s) + (c - b) * (2.0f * s * t) + (d - c) * (t * t)) * 3.0f;
}

BezierPoint bezier_at(BezierNet n, float u, float v) {
  vec4 wu = bezier_weights(u);
  vec4 wv = bezier_weights(v);
  vec3 r0 = bezier_sum(n.r0.p0, n.r0.p1, n.r0.p2, n.r0.p3, wu);
  vec3 r1 = bezier_sum(n.r1.p0, n.r1.p1, n.r1.p2, n.r1.p3, wu);
  vec3 r2 = bezier_sum(n.r2.p0, n.r2.p1, n.r2.p2, n.r2.p3, wu);
  vec3 r3 = bezier_sum(n.r3.p0, n.r3.p1, n.r3.p2, n.r3.p3, wu);
  BezierPoint at;
  at.p = bezier_sum(r0, r1, r2, r3, wv);
  at.dv = bezier_slope(r0, r1, r2, r3, v);
  at.du = bezier_sum(bezier_slope(n.r0.p0, n.r0.p1, n.r0.p2, n.r0.p3, u), bezier_slope(n.r1.p0, n.r1.p1, n.r1.p2, n.r1.p3, u),
                     bezier_slope(n.r2.p0, n.r2.p1, n.r2.p2, n.r2.p3, u), bezier_slope(n.r3.p0, n.r3.p1, n.r3.p2, n.r3.p3, u), wv);
  return at;
}

// The section of the piece with the plane that holds the ray and the piece's normal. Axes: x along the ray, y across that plane, z in it across the
// ray. Along the section grows w, the way over the piece that the ray takes; it is distance z from the ray whose roots are hits. Unlike u and v
// from the ray, u and v from w are never singular.
struct BezierSection {
  float u;
  float v;
  float z;
  float slope;  // of z, and of u and v, over w
  vec2 uv_slope;
  float off;  // how far from here it was taken, squared
};

// At w, near (u, v). `tilt`: of the ray along w and along the normal.
BezierSection bezier_section(BezierNet net, vec2 tilt, float w, vec2 uv) {
  BezierPoint at = bezier_at(net, uv.x, uv.y);
  float w_u = tilt.x * at.du.x - tilt.y * at.du.z;
  float w_v = tilt.x * at.dv.x - tilt.y * at.dv.z;
  float determinant = w_u * at.dv.y - w_v * at.du.y;
  float rest = w - (tilt.x * at.p.x - tilt.y * at.p.z);
  float du = (rest * at.dv.y + at.p.y * w_v) / determinant;
  float dv = -(at.p.y * w_u + rest * at.du.y) / determinant;
  BezierSection section;
  section.u = uv.x + du;
  section.v = uv.y + dv;
  section.z = at.p.z + (at.du.z * du + at.dv.z * dv);
  section.uv_slope = vec2(at.dv.y / determinant, -at.du.y / determinant);
  section.slope = at.du.z * section.uv_slope.x + at.dv.z * section.uv_slope.y;
  section.off = rest * rest + at.p.y * at.p.y;
  return section;
}

// (u, v) at w as seen from a section at w = 0.
vec2 bezier_guess(BezierSection at, float w) { return vec2(at.u + at.uv_slope.x * w, at.v + at.uv_slope.y * w); }

struct BezierRoot {
  vec2 uv;
  bool found;
  bool gave_up;
};

// The root of z between `low` and `high`, measured from `middle`; at `low` its sign is that of z_low, and the other at `high`. Newton's method, or
// bisection where that leaves the bracket. By a little it may: z is taken a step at a time along the section, so that a sign may be wrong next to the root.
BezierRoot bezier_root(BezierNet net, vec2 tilt, BezierSection middle, float origin, vec2 ends, vec2 z_ends, bool search, float grain, float size) {
  float low = ends.x;
  float high = ends.y;
  float margin = 0.02f * (high - low);
  float w = low + (high - low) * (z_ends.x / (z_ends.x - z_ends.y));
  vec2 uv = bezier_guess(middle, w);
  float before = high - low;
  bool going = search;
  for (uint i = 0u; i < BEZIER_STEPS && going; i++) {
    BezierSection at = bezier_section(net, tilt, origin + w, uv);
    bool past = (at.z < 0.0f) != (z_ends.x < 0.0f);
    // Taken from far off along the section, z may have the wrong sign.
    bool sure = at.off <= 4.0f * grain * size;
    low = past || !sure ? low : w;
    high = past && sure ? w : high;
    float step = -at.z / at.slope;
    bool newton = w + step >= low - margin && w + step <= high + margin && (i < 10u || abs(step) < 0.6f * before);
    // Near enough already, and where the slope is small a last step may be long, and lead elsewhere.
    bool near = abs(at.z) <= grain && at.off <= grain * size;
    step = newton ? (near && abs(step) > margin ? 0.0f : step) : near ? 0.0f : 0.5f * (low + high) - w;
    before = maximum(abs(step), 2.0f * grain);
    // Where the bracket closes on nothing, the sign at its end was that of a rounding: there is no root.
    going = !(near || (newton && abs(step) <= grain && at.off <= grain * size) || high - low <= 4.0f * grain);
    uv = vec2(at.u, at.v) + at.uv_slope * step;
    w = w + step;
  }
  BezierRoot root;
  root.uv = uv;
  root.found = search;
  root.gave_up = going;
  return root;
}

// Whether the ray comes near the piece.
bool bezier_may_hit(Primitive s, Ray ray) {
  vec3 to_middle = vec3(s.b) - ray.o;
  vec3 off = to_middle - ray.d * (dot3(to_middle, ray.d) / dot3(ray.d, ray.d));
  float reach = 1.001f * s.b.w + 16.0f * EPSILON * (max_component(abs3(to_middle)) + max_component(abs3(ray.o)));
  return dot3(off, off) <= reach * reach;
}

void bezier_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  vec3 reach = vec3(s.b.w, s.b.w, s.b.w);
  lower = vec3(s.b) - reach;
  upper = vec3(s.b) + reach;
}

// t where the piece is within `hair` of the ray near (u, v), else −1; then (u, v) is in the piece.
float bezier_confirm(Primitive s, BezierNet net, BezierRoot root, float hair, OUT(vec2) uv) {
  uv = vec2(minimum(maximum(root.uv.x, s.a.x), s.a.y), minimum(maximum(root.uv.y, s.a.z), s.a.w));
  vec3 p = bezier_at(net, uv.x, uv.y).p;
  return root.found && abs(p.y) <= hair && abs(p.z) <= hair ? p.x : -T_MISS;
}

float bezier_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  // From afar start near the patch, so that nothing cancels (object_space.glsl).
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
  vec3 normal = vec3(s.c);
  vec3 y = cross3(normal, d);
  vec2 tilt = vec2(sqrt(dot3(y, y)), dot3(normal, d));
  vec3 other = abs(d.x) < 0.5f ? vec3(0.0f, -d.z, d.y) : vec3(-d.z, 0.0f, d.x);
  y = normalize3(tilt.x > 1.0e-3f ? y : other);
  vec3 z = cross3(d, y);
  BezierNet net;
  net.r0 = bezier_row_along(bezier_row(s.head.w), o, d, y, z);
  net.r1 = bezier_row_along(bezier_row(s.head.w + 3u), o, d, y, z);
  net.r2 = bezier_row_along(bezier_row(s.head.w + 6u), o, d, y, z);
  net.r3 = bezier_row_along(bezier_row(s.head.w + 9u), o, d, y, z);

  // Where the section comes into the piece and goes out of it, about, as seen from the middle.
  float beyond = 1.0f + abs(s.c.w);
  vec2 middle = vec2(0.5f * (s.a.x + s.a.y), 0.5f * (s.a.z + s.a.w));
  vec2 size = vec2(0.5f * (s.a.y - s.a.x) * beyond, 0.5f * (s.a.w - s.a.z) * beyond);
  vec3 p = bezier_along(vec3(s.b), o, d, y, z);
  float origin = tilt.x * p.x - tilt.y * p.z;
  BezierSection at = bezier_section(net, tilt, origin, middle);
  float from_u = (at.u - middle.x) / at.uv_slope.x;
  float from_v = (at.v - middle.y) / at.uv_slope.y;
  float half_u = abs(size.x / at.uv_slope.x);
  float half_v = abs(size.y / at.uv_slope.y);
  float from = maximum(-half_u - from_u, -half_v - from_v);
  float to = minimum(half_u - from_u, half_v - from_v);
  bool speck = abs(s.c.w) >= BEZIER_SPECK;
  bool meets = from <= to && !speck && bezier_may_hit(s, ray);
  BezierSection first = bezier_section(net, tilt, origin + from, bezier_guess(at, from));
  BezierSection last = bezier_section(net, tilt, origin + to, bezier_guess(at, to));

  // Where z turns, by the cubic of the same values and slopes at both ends, and Newton's method on that: between, it has a root or none. An error
  // of a turning point counts by its square.
  float length = to - from;
  float rise = (last.z - first.z) / length;
  float cubic = first.slope + last.slope - 2.0f * rise;
  float square = 3.0f * rise - 2.0f * first.slope - last.slope;
  float discriminant = square * square - 3.0f * cubic * first.slope;
  float q = -square - (square < 0.0f ? -1.0f : 1.0f) * sqrt(maximum(discriminant, 0.0f));
  vec2 turns = vec2(first.slope / q, q / (3.0f * cubic));
  turns = turns.y < turns.x ? vec2(turns.y, turns.x) : turns;
  bool turns_0 = discriminant >= 0.0f && turns.x > 0.0f && turns.x < 1.0f;
  bool turns_1 = discriminant >= 0.0f && turns.y > 0.0f && turns.y < 1.0f;
  float low = turns_0 ? from + length * turns.x : from;
  float high = turns_1 ? from + length * turns.y : to;
  float z_low = first.z;
  float z_high = last.z;
  for (uint i = 0u; i < 2u && meets && (turns_0 || turns_1); i++) {
    BezierSection turn = bezier_section(net, tilt, origin + low, bezier_guess(at, low));
    float bend = 2.0f * (square + 3.0f * cubic * ((low - from) / length)) / length;
    float step = i == 0u && turns_0 ? -turn.slope / bend : 0.0f;
    step = abs(step) < 0.25f * length ? step : 0.0f;
    z_low = turns_0 ? turn.z : z_low;
    low = minimum(maximum(low + step, from), to);
    turn = bezier_section(net, tilt, origin + high, bezier_guess(at, high));
    bend = 2.0f * (square + 3.0f * cubic * ((high - from) / length)) / length;
    step = i == 0u && turns_1 ? -turn.slope / bend : 0.0f;
    step = abs(step) < 0.25f * length ? step : 0.0f;
    z_high = turns_1 ? turn.z : z_high;
    high = minimum(maximum(high + step, low), to);
  }

  // The first root that is of this piece, and not behind the ray's start.
  float t = -1.0f;
  float z_from = first.z;
  bool gave_up = false;
  bool search = meets;
  for (uint i = 0u; i < 3u && search; i++) {
    bool change_0 = (z_from < 0.0f) != (z_low < 0.0f);
    bool change_1 = (z_low < 0.0f) != (z_high < 0.0f);
    bool change_2 = (z_high < 0.0f) != (last.z < 0.0f);
    search = change_0 || change_1 || change_2;
    vec2 ends = change_0 ? vec2(from, low) : change_1 ? vec2(low, high) : vec2(high, to);
    vec2 z_ends = change_0 ? vec2(z_from, z_low) : change_1 ? vec2(z_low, z_high) : vec2(z_high, last.z);
    BezierRoot root = bezier_root(net, tilt, at, origin, ends, z_ends, search, grain, s.b.w);
    t = start + bezier_confirm(s, net, root, hair, uv);
    gave_up = gave_up || (root.gave_up && !(t > 0.0f));
    search = search && !(t > 0.0f);

    // Go on behind it.
    z_high = change_0 || change_1 ? z_high : last.z;
    z_low = change_0 ? z_low : z_high;
    z_from = z_low;
    from = change_0 ? low : high;
    low = change_0 ? low : high;
  }

  // A speck of 2^-12 of the patch, where it comes to a point, is flat, and round.
  if (speck) {
    float along = dot3(normal, vec3(s.b) - o) / tilt.y;
    vec3 off = (o + d * along) - vec3(s.b);
    t = dot3(off, off) <= s.b.w * s.b.w ? start + along : -1.0f;
    uv = middle;
  }

  if (gave_up && !(t > 0.0f)) uv = vec2(maximum(start + p.x - s.b.w, 0.0f) / speed, 0.0f);
  return t > 0.0f ? t / speed : gave_up ? T_RAN_OUT : -1.0f;
}

Surface bezier_surface(Primitive s, Ray ray, Hit hit) {
  vec3 x = vec3(1.0f, 0.0f, 0.0f);
  vec3 y = vec3(0.0f, 1.0f, 0.0f);
  vec3 z = vec3(0.0f, 0.0f, 1.0f);
  vec4 patch_ball = bezier_patch(s);
  vec3 o = vec3(patch_ball);
  BezierNet net;
  net.r0 = bezier_row_along(bezier_row(s.head.w), o, x, y, z);
  net.r1 = bezier_row_along(bezier_row(s.head.w + 3u), o, x, y, z);
  net.r2 = bezier_row_along(bezier_row(s.head.w + 6u), o, x, y, z);
  net.r3 = bezier_row_along(bezier_row(s.head.w + 9u), o, x, y, z);
  BezierPoint at = bezier_at(net, hit.uv.x, hit.uv.y);

  // Where the derivatives are parallel, or one is 0, as where an edge is one point, the piece's normal is as near as can be.
  vec3 n = cross3(at.du, at.dv);
  float size = dot3(at.du, at.du) + dot3(at.dv, at.dv);
  n = dot3(n, n) > 1.0e-14f * (size * size) ? normalize3(n) : vec3(s.c);
  Surface surface;
  surface.p = o + at.p;
  surface.normal_geometric = s.c.w < 0.0f ? -n : n;
  surface.normal = surface.normal_geometric;
  surface.uv = hit.uv;
  surface.offset = 8.0f * EPSILON * dot3(abs3(n), abs3(surface.p) + abs3(o)) + 48.0f * EPSILON * patch_ball.w;
  return surface;
}

SHADER_END
#endif
