// x² + z² ≤ 1, |y| ≤ 1 in object space (geometry/object_space.glsl).   parameters: 1 where there are no caps
#ifndef CYLINDER_GLSL
#define CYLINDER_GLSL
#include "geometry/revolution.glsl"

SHADER_BEGIN

vec3 cylinder_equation(ObjectRay r) {
  return vec3(r.d.x * r.d.x + r.d.z * r.d.z, r.o.x * r.d.x + r.o.z * r.d.z, (r.o.x * r.o.x + r.o.z * r.o.z) - 1.0f);
}

float cylinder_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  ObjectRay r = object_ray(s, ray, 1.4142136f);
  uv = vec2(0.0f, 0.0f);
  return revolution_intersect(ray, r, cylinder_equation(r), cylinder_equation(from_nearest(r)), -1.0f, 1.0f,
                              object_parameters(s).x != 0.0f, uv.x);
}

bool cylinder_reject(Primitive s, Ray ray) { return false; }

void cylinder_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 cylinder_level(Primitive s, vec3 p) {
  vec3 q = point_into_object(s, p);
  return revolution_level(s, vec3(q.x, 0.0f, q.z), 0.5f * ((q.x * q.x + q.z * q.z) - 1.0f), q.y, -1.0f, 1.0f);
}

Surface cylinder_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, 1.4142136f), hit);
  return revolution_surface(s, ray, p, hit.uv.x, -1.0f, -1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 1.0f);
}

SHADER_END
#endif
