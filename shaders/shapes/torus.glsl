// (√(x² + z²) − 1)² + y² = minor² in object space (geometry/object_space.glsl), minor < 1.   parameters: minor
#ifndef TORUS_GLSL
#define TORUS_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

#define TORUS_CUBIC_STEPS 24u
#define TORUS_STEPS 48u

// Below 0 inside. It does not cancel where the quartic does, and has its sign.
float torus_depth(vec3 p, float minor) {
  float q = sqrt(p.x * p.x + p.z * p.z) - 1.0f;
  return (q * q + p.y * p.y) - minor * minor;
}

// The largest root of x³ + p·x = q, q ≥ 0: beyond it the cubic is convex, so Newton's steps come down to it from a bound, never past it. They are
// slow only where the cubic is flat, and where it is flat its root need not be sharp.
float torus_cubic_root(float p, float q) {
  float u = sqrt(maximum(-p, 0.0f));
  float linear = p < 0.0f ? -2.0f * p : p;
  float x = u + minimum((q + 2.0f) / 3.0f, linear > 0.0f ? q / linear : 1.0f);
  float step = 1.0f;
  for (uint i = 0u; i < TORUS_CUBIC_STEPS && step > 1.0e-6f; i++) {
    step = (x * (x * x + p) - q) / maximum(3.0f * x * x + p, 1.0e-20f);
    x = x - step;
  }
  return x;
}

// uv.x: t in object space, where it has more digits; at the iteration limit as in records.h.
float torus_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  float minor = object_parameters(s).x;
  ObjectRay r = object_ray(s, ray, 1.0f + minor);

  // Measured from the point nearest to the centre, in object space's unit, the quartic is x⁴ + 2(k − 2a)x² − 8bx + …, without a cubic term.
  float slowness = 1.0f / sqrt(dot3(r.d, r.d));
  vec3 d = r.d * slowness;
  float start = dot3(r.o, d);
  vec3 o = r.o - d * start;
  float k = (dot3(o, o) + 1.0f) - minor * minor;
  float a = d.x * d.x + d.z * d.z;
  float b = o.x * d.x + o.z * d.z;

  // From the ray's start, or where it enters a ball about the torus, to where it leaves the ball.
  float reach = 1.01f * (1.0f + minor);
  float half_chord = reach * reach - dot3(o, o);
  float end = sqrt(maximum(half_chord, 0.0f));
  float from = start - r.t / slowness;
  float begin = maximum(from, -end);
  bool inside = from > -end && torus_depth(r.o, minor) < 0.0f;
  float since = begin;  // the turning points before it have been passed
#if HAS_CSG
  // In queries of CSG objects the stretches are those of the whole line, for every caller.
  begin = ray.side == SIDE_UNKNOWN ? begin : -end;
  inside = ray.side == SIDE_UNKNOWN ? inside : ray.side == SIDE_INSIDE;
  since = ray.side == SIDE_UNKNOWN ? begin : start + (ray.after - r.t) / slowness;
#endif

  // The extrema of the quartic: the roots of its derivative, a cubic. Between them the quartic has one root or none.
  float p = k - 2.0f * a;
  float q = 2.0f * b;
  float largest = torus_cubic_root(p, abs(q));
  float discriminant = -3.0f * largest * largest - 4.0f * p;
  float root = sqrt(maximum(discriminant, 0.0f));
  float upper = discriminant > 0.0f ? 0.5f * (root - largest) : largest;
  float lower = discriminant > 0.0f ? -0.5f * (root + largest) : largest;
  float c0 = minimum(maximum(q < 0.0f ? -largest : lower, begin), end);
  float c1 = minimum(maximum(q < 0.0f ? -upper : upper, begin), end);
  float c2 = minimum(maximum(q < 0.0f ? -lower : largest, begin), end);

  // The first stretch on which the ray goes in or out. At a turn that is not beyond the start nothing has changed yet.
  bool past0 = c0 > since && (torus_depth(o + d * c0, minor) < 0.0f) != inside;
  bool past1 = c1 > since && (torus_depth(o + d * c1, minor) < 0.0f) != inside;
  bool past2 = c2 > since && (torus_depth(o + d * c2, minor) < 0.0f) != inside;
  float low = past0 ? begin : past1 ? c0 : past2 ? c1 : c2;
  float high = past0 ? c0 : past1 ? c1 : past2 ? c2 : end;
  bool hits = half_chord >= 0.0f && begin < end && (past0 || past1 || past2 || inside);

  // Newton's method on the depth, or bisection where that leaves the stretch or gains too little.
  float x = 0.5f * (low + high);
  float before = high - low;
  float step = hits ? before : 0.0f;
  for (uint i = 0u; i < TORUS_STEPS && abs(step) > 4.0f * EPSILON; i++) {
    vec3 at = o + d * x;
    float distance = sqrt(at.x * at.x + at.z * at.z);
    float depth = torus_depth(at, minor);
    bool beyond = (depth < 0.0f) != inside;
    high = beyond ? x : high;
    low = beyond ? low : x;
    float slope = 2.0f * ((distance - 1.0f) * (at.x * d.x + at.z * d.z) / distance + at.y * d.y);
    float next = x - depth / slope;
    bool newton = next > low && next < high && abs(next - x) < 0.5f * abs(before);
    next = newton ? next : 0.5f * (low + high);
    // A point within the rounding of the distance counts as on the surface.
    next = abs(depth) <= 4.0f * EPSILON * minor ? x : next;
    before = step;
    step = next - x;
    x = next;
  }
  bool state = abs(step) <= 4.0f * EPSILON;
  float t = ((state ? x : low) - start) * slowness;
  uv.x = state ? t : r.t + t;
  return !hits ? T_NONE : state ? r.t + t : T_ITERATION_LIMIT;
}

bool torus_reject(Primitive s, Ray ray) { return false; }

void torus_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  float minor = object_parameters(s).x;
  object_box(s, vec3(1.0f + minor, minor, 1.0f + minor), lower, upper);
}

vec4 torus_level(Primitive s, vec3 p) {
  float minor = object_parameters(s).x;
  vec3 q = point_into_object(s, p);
  float distance = maximum(sqrt(q.x * q.x + q.z * q.z), 1.0e-20f);
  float share = 1.0f - 1.0f / distance;
  return level_out_of_object(s, vec3(q.x * share, q.y, q.z * share), 0.5f * torus_depth(q, minor));
}

Surface torus_surface(Primitive s, Ray ray, Hit hit) {
  // Onto the tube, along its own radius.
  float minor = object_parameters(s).x;
  ObjectRay r = object_ray(s, ray, 1.0f + minor);
  vec3 p = r.o + r.d * hit.uv.x;
  float distance = sqrt(p.x * p.x + p.z * p.z);
  vec2 around = distance > 0.0f ? vec2(p.x / distance, p.z / distance) : vec2(1.0f, 0.0f);
  vec2 tube = vec2(distance - 1.0f, p.y);
  tube = tube / sqrt(tube.x * tube.x + tube.y * tube.y);
  vec3 gradient = vec3(around.x * tube.x, tube.y, around.y * tube.x);
  float ring = 1.0f + minor * tube.x;
  p = vec3(around.x * ring, minor * tube.y, around.y * ring);

  float u = 0.5f + atan_yx(-around.y, around.x) / (2.0f * PI);
  float v = 0.5f + atan_yx(tube.y, tube.x) / (2.0f * PI);
  return object_surface(s, p, gradient,
                        uv_field(vec2(u < 1.0f ? u : 0.0f, v < 1.0f ? v : 0.0f), turn_gradient(p),
                                 vec3(-tube.y * around.x, tube.x, -tube.y * around.y) / (2.0f * PI * minor)));
}

SHADER_END
#endif
