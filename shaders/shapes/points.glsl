// |x − c| = r around each point c of a cloud: a primitive is one point, and all points of a cloud have one id.
#ifndef POINTS_GLSL
#define POINTS_GLSL
#include "geometry/ray.glsl"
#include "records.h"
#include "shapes/sphere.glsl"

SHADER_BEGIN

// `a` is that of a sphere (shapes/sphere.glsl).
vec3 points_color(Primitive s) { return vec3(s.b); }
float points_number(Primitive s) { return s.b.w; }  // decides between points that a ray hits at the same t

float points_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  float t = sphere_intersect(s, ray, uv);
  uv = vec2(points_number(s), 0.0f);
  return t;
}

bool points_reject(Primitive s, Ray ray) { return sphere_reject(s, ray); }

void points_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { sphere_box(s, lower, upper); }

Surface points_surface(Primitive s, Ray ray, Hit hit) {
  Surface surface = sphere_surface_at(s, sphere_normal(s, ray, hit));
  set_gradients(surface, vec3(0.0f, 0.0f, 0.0f), vec3(0.0f, 0.0f, 0.0f));
  return surface;
}

SHADER_END
#endif
