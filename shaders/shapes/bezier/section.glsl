// Intersects a ray with a piece of a Bézier patch: the section of the piece with a plane through the ray, in arcs, and their roots
// (shapes/bezier.glsl).
#ifndef BEZIER_SECTION_GLSL
#define BEZIER_SECTION_GLSL
#include "math/math.glsl"

SHADER_BEGIN

// Limit on the steps of Newton's method for a root.
#define BEZIER_STEPS 40u

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

vec2 bezier_within(vec4 range, vec2 uv) {
  return vec2(minimum(maximum(uv.x, range.x), range.y), minimum(maximum(uv.y, range.z), range.w));
}

// True if three points of a section, and hence the part between, are all beyond one border, not just so.
bool bezier_outside(vec4 range, vec2 a, vec2 b, vec2 c) {
  float room_u = 0.02f * (range.y - range.x);
  float room_v = 0.02f * (range.w - range.z);
  return maximum(maximum(a.x, b.x), c.x) < range.x - room_u || minimum(minimum(a.x, b.x), c.x) > range.y + room_u ||
         maximum(maximum(a.y, b.y), c.y) < range.z - room_v || minimum(minimum(a.y, b.y), c.y) > range.w + room_v;
}

// The section of the piece with the plane that holds the ray and the piece's normal. Axes: x along the ray, y across that plane, z in it across the
// ray. Along the section grows w, the way over the piece that the ray takes; it is distance z from the ray whose roots are hits. Unlike u and v
// from the ray, u and v from w are never singular.
struct BezierSection {
  float w;
  vec2 uv;
  float z;
  float slope;  // slope of z, and of u and v, over w
  vec2 uv_slope;
  float off;  // squared distance from here to the point where the patch was evaluated
};

// The section of the piece `range` at w, near (u, v). `tilt`: of the ray along w and along the normal; where w begins. Beyond its borders,
// where the patch may fold, the piece goes on as its tangent planes.
BezierSection bezier_section(BezierNet net, vec4 range, vec3 tilt, float w, vec2 uv) {
  vec2 within = bezier_within(range, uv);
  BezierPoint at = bezier_at(net, within.x, within.y);
  at.p = at.p + (at.du * (uv.x - within.x) + at.dv * (uv.y - within.y));
  float w_u = tilt.x * at.du.x - tilt.y * at.du.z;
  float w_v = tilt.x * at.dv.x - tilt.y * at.dv.z;
  float determinant = w_u * at.dv.y - w_v * at.du.y;
  float rest = (tilt.z + w) - (tilt.x * at.p.x - tilt.y * at.p.z);
  float du = (rest * at.dv.y + at.p.y * w_v) / determinant;
  float dv = -(at.p.y * w_u + rest * at.du.y) / determinant;
  BezierSection section;
  section.w = w;
  section.uv = vec2(uv.x + du, uv.y + dv);
  section.z = at.p.z + (at.du.z * du + at.dv.z * dv);
  section.uv_slope = vec2(at.dv.y / determinant, -at.du.y / determinant);
  section.slope = at.du.z * section.uv_slope.x + at.dv.z * section.uv_slope.y;
  section.off = rest * rest + at.p.y * at.p.y;
  return section;
}

// The section at w, if `wanted`, as near as float32 comes to it: each iteration squares the distance that it is off.
BezierSection bezier_settle(BezierNet net, vec4 range, vec3 tilt, float w, vec2 uv, float fine, bool wanted) {
  BezierSection at;
  at.w = w;
  at.uv = uv;
  at.z = 0.0f;
  at.slope = 0.0f;
  at.uv_slope = vec2(0.0f, 0.0f);
  at.off = 0.0f;
  bool going = wanted;
  for (uint i = 0u; i < 4u && going; i++) {
    at = bezier_section(net, range, tilt, w, at.uv);
    going = at.off > fine;
  }
  return at;
}

// (u, v) at the share s of the way from one section to another: the cubic with their values and slopes.
vec2 bezier_between(BezierSection a, BezierSection b, float s) {
  float r = 1.0f - s;
  float length = b.w - a.w;
  return a.uv * (r * r * (1.0f + 2.0f * s)) + b.uv * (s * s * (1.0f + 2.0f * r)) + (a.uv_slope * r - b.uv_slope * s) * (length * s * r);
}

// z from one section to the next, as the cubic z + s·(slope + s·(square + s·cubic)), 0 ≤ s ≤ 1.
struct BezierArc {
  float z;
  float slope;
  float square;
  float cubic;
  vec2 turns;    // where it turns, each brought to 0 … 1
  bool doubted;  // whether z may have roots where it has none
};

float bezier_arc_z(BezierArc arc, float s) { return arc.z + s * (arc.slope + s * (arc.square + s * arc.cubic)); }

// The section at its share s, as it and (u, v)'s cubic have it.
BezierSection bezier_on_arc(BezierSection a, BezierSection b, BezierArc arc, float s) {
  float r = 1.0f - s;
  float length = b.w - a.w;
  BezierSection at;
  at.w = a.w + length * s;
  at.uv = bezier_between(a, b, s);
  at.z = bezier_arc_z(arc, s);
  at.slope = (arc.slope + s * (2.0f * arc.square + 3.0f * s * arc.cubic)) / length;
  at.uv_slope = (b.uv - a.uv) * (6.0f * s * r / length) + a.uv_slope * (r * r - 2.0f * s * r) + b.uv_slope * (s * s - 2.0f * s * r);
  at.off = 0.0f;
  return at;
}

// An arc is doubted if z, where it turns or nearly does, is nearer to 0 than four times the effect of its next two degrees.
BezierArc bezier_arc(BezierSection a, BezierSection b, BezierSection half_way, float grain) {
  BezierArc arc;
  float length = b.w - a.w;
  float rise = b.z - a.z;
  float last_slope = b.slope * length;
  arc.z = a.z;
  arc.slope = a.slope * length;
  arc.square = 3.0f * rise - 2.0f * arc.slope - last_slope;
  arc.cubic = arc.slope + last_slope - 2.0f * rise;
  // z and its slope half-way bound the effect of its next two degrees.
  float slope_off = half_way.slope * length - (arc.slope + arc.square + 0.75f * arc.cubic);
  float off = 4.0f * (abs(half_way.z - bezier_arc_z(arc, 0.5f)) + 0.25f * abs(slope_off));

  float discriminant = arc.square * arc.square - 3.0f * arc.cubic * arc.slope;
  float q = -arc.square - (arc.square < 0.0f ? -1.0f : 1.0f) * sqrt(maximum(discriminant, 0.0f));
  float s = arc.slope / q;
  float t = q / (3.0f * arc.cubic);
  // A division by 0 is no turn, or one at 0.
  s = minimum(maximum(s == s ? s : 0.0f, 0.0f), 1.0f);
  t = minimum(maximum(t == t ? t : 0.0f, 0.0f), 1.0f);
  bool low = discriminant >= -9.0f * off * abs(arc.cubic) && (abs(bezier_arc_z(arc, s)) < off || abs(bezier_arc_z(arc, t)) < off);
  bool ends = (abs(a.z) < off && abs(arc.slope) < 16.0f * off) || (abs(b.z) < off && abs(last_slope) < 16.0f * off);
  arc.turns = discriminant > 0.0f ? vec2(minimum(s, t), maximum(s, t)) : vec2(0.0f, 0.0f);
  arc.doubted = (low || ends) && off > 2.0f * grain;
  return arc;
}

struct BezierRoot {
  vec2 uv;
  bool found;
  bool gave_up;
};

// The root of z between ends.x and ends.y, from (u, v); at ends.x its sign is that of z_ends.x, and the other at ends.y. Newton's method,
// or bisection where that leaves the bracket by more than a little. z is taken a step at a time, so its sign may be wrong next to the root.
BezierRoot bezier_root(BezierNet net, vec4 range, vec3 tilt, vec2 uv, float start, vec2 ends, vec2 z_ends, bool search, float grain, float size) {
  float low = ends.x;
  float high = ends.y;
  float margin = 0.02f * (high - low);
  float w = start;
  float before = high - low;
  bool going = search;
  for (uint i = 0u; i < BEZIER_STEPS && going; i++) {
    BezierSection at = bezier_section(net, range, tilt, w, uv);
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
    // If the bracket closes without a root, rounding decided the sign at its end: there is no root.
    going = !(near || (newton && abs(step) <= grain && at.off <= grain * size) || high - low <= 4.0f * grain);
    uv = at.uv + at.uv_slope * step;
    w = w + step;
  }
  BezierRoot root;
  root.uv = uv;
  root.found = search;
  root.gave_up = going;
  return root;
}

SHADER_END
#endif
