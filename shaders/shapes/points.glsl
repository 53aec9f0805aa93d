// |x − c| = r around each point c of a cloud, or the disk (x − c) · n = 0, |x − c| ≤ r: a primitive is one point, and all points of a
// cloud have one id.
#ifndef POINTS_GLSL
#define POINTS_GLSL
#include "geometry/ray.glsl"
#include "records.h"
#include "shapes/sphere.glsl"

SHADER_BEGIN

// `a` is that of a sphere (shapes/sphere.glsl).
vec3 points_color(Primitive s) { return vec3(s.b); }
float points_number(Primitive s) { return s.b.w; }  // decides between points that a ray hits at the same t

bool points_is_disk(Primitive s) { return s.c.w != 0.0f; }
vec3 points_normal(Primitive s) { return vec3(s.c); }  // the disk's unit normal

// The t from which values of a disk are computed: that of the ray's start, or from afar that of its point nearest to the centre. So
// nothing cancels.
float points_start(Primitive s, Ray ray) {
  vec3 f = ray.o - sphere_center(s);
  float r = sphere_radius(s);
  return dot3(f, f) > 4.0f * r * r ? -dot3(f, ray.d) / dot3(ray.d, ray.d) : 0.0f;
}

// A ray in the plane or parallel to it divides by zero: infinity and NaN are both misses, no epsilon decides. A ray that points_reject
// rejects misses, whatever the rounding.
float point_disk_intersect(Primitive s, Ray ray) {
  float start = points_start(s, ray);
  vec3 o = (ray.o - sphere_center(s)) + ray.d * start;
  float t = -dot3(points_normal(s), o) / dot3(points_normal(s), ray.d);
  vec3 p = o + ray.d * t;
  bool inside = dot3(p, p) <= sphere_radius(s) * sphere_radius(s) && sphere_discriminant(s, ray) >= 0.0f;
  return inside ? start + t : T_NONE;
}

float points_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  float t = points_is_disk(s) ? point_disk_intersect(s, ray) : sphere_intersect(s, ray, uv);
  uv = vec2(points_number(s), 0.0f);
  return t;
}

bool points_reject(Primitive s, Ray ray) { return sphere_reject(s, ray); }

void points_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { sphere_box(s, lower, upper); }

Surface points_surface(Primitive s, Ray ray, Hit hit) {
  bool disk = points_is_disk(s);
  vec3 n = points_normal(s);
  Surface surface = sphere_surface_at(s, disk ? n : sphere_normal(s, ray, hit));
  if (disk) {
    float start = points_start(s, ray);
    vec3 p = ((ray.o - sphere_center(s)) + ray.d * start) + ray.d * (hit.t - start);
    surface.p = sphere_center(s) + (p - n * dot3(n, p));
  }
  set_gradients(surface, vec3(0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 0.0f));
  return surface;
}

SHADER_END
#endif
