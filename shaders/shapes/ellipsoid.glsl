// |x| = 1 in object space (geometry/object_space.glsl).
#ifndef ELLIPSOID_GLSL
#define ELLIPSOID_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

// The intersection of a sphere (sphere.glsl), in object space.
float ellipsoid_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  ObjectRay r = object_ray(s, ray, 1.0f);
  float a = dot3(r.d, r.d);
  float b = -dot3(r.o, r.d);
  vec3 nearest = r.o + r.d * (b / a);
  float discriminant = 1.0f - dot3(nearest, nearest);
  float c = dot3(r.o, r.o) - 1.0f;
  float root = sqrt(maximum(a * discriminant, 0.0f));
  float q = b < 0.0f ? b - root : b + root;
  float s0 = c / q;
  float s1 = q / a;
  float low = r.t + (s0 < s1 ? s0 : s1);
  float high = r.t + (s0 < s1 ? s1 : s0);
  return discriminant > 0.0f ? (ENTERS(ray, low) ? low : high) : T_NONE;
}

bool ellipsoid_reject(Primitive s, Ray ray) { return false; }

void ellipsoid_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 ellipsoid_level(Primitive s, vec3 p) {
  vec3 q = point_into_object(s, p);
  return level_out_of_object(s, q, 0.5f * (dot3(q, q) - 1.0f));
}

Surface ellipsoid_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, 1.0f), hit);
  p = dot3(p, p) > 0.0f ? normalize3(p) : vec3(0.0f, 1.0f, 0.0f);
  float u = 0.5f + atan_yx(-p.z, p.x) / (2.0f * PI);
  float v = atan_yx(sqrt(p.x * p.x + p.z * p.z), -p.y) / PI;
  return object_surface(s, p, p, uv_field(vec2(u < 1.0f ? u : 0.0f, v), turn_gradient(p), pole_gradient(p) / PI));
}

SHADER_END
#endif
