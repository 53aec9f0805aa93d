// x² + z² ≤ square·y² + waist², bottom ≤ y ≤ bottom + 2 in object space (geometry/object_space.glsl), the widest radius 1, the waist at y = 0.
//   parameters: 1 where there are no caps; square; waist²; bottom
#ifndef HYPERBOLOID_GLSL
#define HYPERBOLOID_GLSL
#include "geometry/revolution.glsl"

SHADER_BEGIN

#define HYPERBOLOID_REACH 2.2360680f

vec3 hyperboloid_equation(ObjectRay r, float square, float waist_squared) {
  return vec3((r.d.x * r.d.x + r.d.z * r.d.z) - square * r.d.y * r.d.y,
              (r.o.x * r.d.x + r.o.z * r.d.z) - square * r.o.y * r.d.y,
              (r.o.x * r.o.x + r.o.z * r.o.z) - (square * r.o.y * r.o.y + waist_squared));
}

float hyperboloid_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  vec4 parameters = object_parameters(s);
  ObjectRay r = object_ray(s, ray, HYPERBOLOID_REACH);
  vec3 equation = hyperboloid_equation(r, parameters.y, parameters.z);
  vec3 nearest = hyperboloid_equation(from_nearest(r), parameters.y, parameters.z);
  uv = vec2(0.0f, 0.0f);
  return revolution_intersect(ray, r, equation, nearest, parameters.w, parameters.w + 2.0f, parameters.x != 0.0f, uv.x);
}

bool hyperboloid_reject(Primitive s, Ray ray) { return false; }

void hyperboloid_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 2.0f, 1.0f), lower, upper); }

vec4 hyperboloid_level(Primitive s, vec3 p) {
  vec4 parameters = object_parameters(s);
  vec3 q = point_into_object(s, p);
  float value = (q.x * q.x + q.z * q.z) - (parameters.y * q.y * q.y + parameters.z);
  return revolution_level(s, vec3(q.x, -parameters.y * q.y, q.z), 0.5f * value, q.y, parameters.w, parameters.w + 2.0f);
}

Surface hyperboloid_surface(Primitive s, Ray ray, Hit hit) {
  vec4 parameters = object_parameters(s);
  vec3 p = at_hit(object_ray(s, ray, HYPERBOLOID_REACH), hit);
  float bottom = parameters.w;
  float top = bottom + 2.0f;
  float y = hit.uv.x == PART_BOTTOM ? bottom : hit.uv.x == PART_TOP ? top : minimum(maximum(p.y, bottom), top);
  float radius = sqrt(parameters.y * y * y + parameters.z);
  return revolution_surface(s, ray, p, hit.uv.x, bottom, bottom, top, radius, parameters.y * y / radius, parameters.y, radius);
}

SHADER_END
#endif
