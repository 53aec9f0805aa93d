// x² + z² ≤ y ≤ 1 in object space (geometry/object_space.glsl).   parameters: 1 where there is no cap
#ifndef PARABOLOID_GLSL
#define PARABOLOID_GLSL
#include "geometry/revolution.glsl"

SHADER_BEGIN

#define PARABOLOID_REACH 1.4142136f

vec3 paraboloid_equation(ObjectRay r) {
  return vec3(r.d.x * r.d.x + r.d.z * r.d.z, (r.o.x * r.d.x + r.o.z * r.d.z) - 0.5f * r.d.y,
              (r.o.x * r.o.x + r.o.z * r.o.z) - r.o.y);
}

// The plane y = 0 cuts nothing off: it only touches the tip.
float paraboloid_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  ObjectRay r = object_ray(s, ray, PARABOLOID_REACH);
  uv = vec2(0.0f, 0.0f);
  return revolution_intersect(ray, r, paraboloid_equation(r), paraboloid_equation(from_nearest(r)), -1.0f, 1.0f,
                              object_parameters(s).x != 0.0f, uv.x);
}

bool paraboloid_reject(Primitive s, Ray ray) { return false; }

void paraboloid_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 paraboloid_level(Primitive s, vec3 p) {
  vec3 q = point_into_object(s, p);
  return revolution_level(s, vec3(2.0f * q.x, -1.0f, 2.0f * q.z), (q.x * q.x + q.z * q.z) - q.y, q.y, -1.0f, 1.0f);
}

Surface paraboloid_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, PARABOLOID_REACH), hit);

  // Bring the height onto the side along its normal: near the tip, the root of a height that is off by a rounding is far off.
  float squared = p.x * p.x + p.z * p.z;
  float height = p.y + (squared - p.y) / (4.0f * squared + 1.0f);
  p.y = hit.uv.x == PART_SIDE ? minimum(maximum(height, 0.0f), 1.0f) : p.y;
  float radius = sqrt(maximum(p.y, 0.0f));
  return revolution_surface(s, ray, p, hit.uv.x, -1.0f, 0.0f, 1.0f, radius, 0.5f / maximum(radius, 1.0e-6f), 0.0f, 1.0f);
}

SHADER_END
#endif
