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
  Surface surface = object_surface(s, p, vec3(0.0f, 1.0f, 0.0f),
                        uv_field(vec2(0.5f + 0.5f * p.x, 0.5f - 0.5f * p.z), vec3(0.5f, 0.0f, 0.0f), vec3(0.0f, 0.0f, -0.5f)));
  float distance = sqrt(p.x * p.x + p.z * p.z);
  if (distance > 0.0f) {
    vec3 out_there = vec3(p.x / distance, 0.0f, p.z / distance);
    float margin = object_room(s, ray, p, surface.offset) * steepness(s, out_there);
    float inner = sqrt(object_parameters(s).x);
    float kept = inside_ends(distance, inner, 1.0f, margin);
    surface.inward = step_out_of_object(s, out_there * ((inner > 0.0f ? kept : minimum(distance, 1.0f - minimum(margin, 1.0f))) - distance));
  }
  return surface;
}

SHADER_END
#endif
