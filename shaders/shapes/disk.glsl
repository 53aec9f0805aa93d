// y = 0, inner² ≤ x² + z² ≤ 1 in object space (geometry/object_space.glsl).   parameters: inner²
#ifndef DISK_GLSL
#define DISK_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

// A ray in the plane or parallel to it divides by zero: infinity and NaN are both misses, no epsilon decides.
float disk_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  ObjectRay r = object_ray(s, ray, 1.0f);
  float t = -r.o.y / r.d.y;
  float x = r.o.x + r.d.x * t;
  float z = r.o.z + r.d.z * t;
  float squared = x * x + z * z;
  return squared >= object_parameters(s).x && squared <= 1.0f ? r.t + t : -1.0f;
}

bool disk_reject(Primitive s, Ray ray) { return false; }

void disk_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 0.0f, 1.0f), lower, upper); }

Surface disk_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, 1.0f), hit);
  p.y = 0.0f;
  return object_surface(s, p, vec3(0.0f, 1.0f, 0.0f),
                        uv_field(vec2(0.5f + 0.5f * p.x, 0.5f - 0.5f * p.z), vec3(0.5f, 0.0f, 0.0f), vec3(0.0f, 0.0f, -0.5f)));
}

SHADER_END
#endif
