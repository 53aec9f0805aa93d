// ‖‖x, z‖_p, y‖_q ≤ 1 in object space (geometry/object_space.glsl), where ‖a, b‖_n = (|a|^n + |b|^n)^(1/n), p, q ≥ 1.   parameters: p, q
#ifndef SUPERELLIPSOID_GLSL
#define SUPERELLIPSOID_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

#define SUPERELLIPSOID_STEPS 64u
#define SUPERELLIPSOID_REACH 1.7320508f

// ‖a, b‖_n for a, b ≥ 0, and its derivatives by a and b. Taken from the larger one, no power is above 1.
vec3 power_norm(float a, float b, float n) {
  float larger = maximum(a, b);
  float ratio = larger > 0.0f ? minimum(a, b) / larger : 0.0f;
  float power = ratio > 0.0f ? exp_negative(n * log_positive(maximum(ratio, 1.0e-30f))) : 0.0f;
  float share = exp_negative(-log_positive(1.0f + power) / n);  // share of the larger in the norm
  float by_larger = 1.0f / ((1.0f + power) * share);
  float by_smaller = ratio > 0.0f ? power / ratio * by_larger : 0.0f;
  return a < b ? vec3(larger / share, by_smaller, by_larger) : vec3(larger / share, by_larger, by_smaller);
}

// Gradient and value of the norm whose unit ball the shape is.
vec4 superellipsoid_norm(vec3 p, vec4 parameters) {
  vec3 around = power_norm(abs(p.x), abs(p.z), parameters.x);
  vec3 whole = power_norm(around.x, abs(p.y), parameters.y);
  float x = whole.y * around.y;
  float z = whole.y * around.z;
  return vec4(p.x < 0.0f ? -x : x, p.y < 0.0f ? -whole.z : whole.z, p.z < 0.0f ? -z : z, whole.x);
}

// A norm is convex along a ray. From where the ray hits the cube around the shape, on the way in or if it starts inside on the way out,
// Newton's steps come towards the surface and never past it. Where the ray misses, they pass the least value, and the slope turns. At the
// iteration limit the ray has hit nothing yet.
float superellipsoid_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec4 parameters = object_parameters(s);
  ObjectRay r = object_ray(s, ray, SUPERELLIPSOID_REACH);
  float least = 1.0e-12f * max_component(abs3(r.d));
  vec3 inverse = vec3(bounded_inverse(r.d.x, least), bounded_inverse(r.d.y, least), bounded_inverse(r.d.z, least));
  vec3 a = (vec3(-1.0f, -1.0f, -1.0f) - r.o) * inverse;
  vec3 b = (vec3(1.0f, 1.0f, 1.0f) - r.o) * inverse;
  float near = maximum(maximum(minimum(a.x, b.x), minimum(a.y, b.y)), minimum(a.z, b.z));
  float far = minimum(minimum(maximum(a.x, b.x), maximum(a.y, b.y)), maximum(a.z, b.z));
  float start = -r.t;
  bool inside = near < start && start < far && superellipsoid_norm(r.o, parameters).w < 1.0f;
#if HAS_CSG
  start = ray.side == SIDE_UNKNOWN ? start : T_NONE;
  inside = ray.side == SIDE_UNKNOWN ? inside : ray.side == SIDE_INSIDE;
#endif

  float x = inside ? far : maximum(near, start);
  bool hits = x <= far;
  float excess = 1.0f;
  for (uint i = 0u; i < SUPERELLIPSOID_STEPS && hits && excess > 4.0f * EPSILON; i++) {
    vec4 norm = superellipsoid_norm(r.o + r.d * x, parameters);
    float slope = dot3(vec3(norm), r.d);
    excess = norm.w - 1.0f;
    bool towards = inside ? slope > 0.0f : slope < 0.0f;
    hits = inside || towards || excess <= 4.0f * EPSILON;
    x = towards ? x - excess / slope : x;
    excess = inside && !towards ? 0.0f : excess;
    hits = hits && (inside || x <= far);
  }
  uv.x = inside ? 0.0f : r.t + x;
  // Not as !(…) in front: Mesa 22.3.6 takes the opposite comparison then, which NaN passes.
  return hits && x > start ? (excess > 4.0f * EPSILON ? T_ITERATION_LIMIT : r.t + x) : T_NONE;
}

bool superellipsoid_reject(Primitive s, Ray ray) { return false; }

void superellipsoid_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper);
}

vec4 superellipsoid_level(Primitive s, vec3 p) {
  vec4 norm = superellipsoid_norm(point_into_object(s, p), object_parameters(s));
  return level_out_of_object(s, vec3(norm), norm.w - 1.0f);
}

Surface superellipsoid_surface(Primitive s, Ray ray, Hit hit) {
  // Onto the surface, towards the centre: there the norm is in proportion.
  vec4 parameters = object_parameters(s);
  vec3 p = at_hit(object_ray(s, ray, SUPERELLIPSOID_REACH), hit);
  p = p / superellipsoid_norm(p, parameters).w;
  vec4 norm = superellipsoid_norm(p, parameters);
  float u = 0.5f + atan_yx(-p.z, p.x) / (2.0f * PI);
  float v = atan_yx(sqrt(p.x * p.x + p.z * p.z), -p.y) / PI;
  Surface surface = object_surface(s, p, vec3(norm), uv_field(vec2(u < 1.0f ? u : 0.0f, v), turn_gradient(p), pole_gradient(p) / PI));
  // The powers add rounding too.
  surface.offset = 2.0f * surface.offset;
  return surface;
}

SHADER_END
#endif
