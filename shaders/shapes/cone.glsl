// x² + z² ≤ w², w = 1 − taper·y, 0 ≤ y ≤ 1 in object space (geometry/object_space.glsl), 0 < taper ≤ 1.   parameters: 1 where there are no caps; taper
#ifndef CONE_GLSL
#define CONE_GLSL
#include "geometry/revolution.glsl"

SHADER_BEGIN

vec3 cone_equation(ObjectRay r, float taper) {
  float w = 1.0f - taper * r.o.y;
  float dw = -taper * r.d.y;
  return vec3((r.d.x * r.d.x + r.d.z * r.d.z) - dw * dw, (r.o.x * r.d.x + r.o.z * r.d.z) - w * dw,
              (r.o.x * r.o.x + r.o.z * r.o.z) - w * w);
}

float cone_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  vec4 parameters = object_parameters(s);
  ObjectRay r = object_ray(s, ray, 1.4142136f);
  uv = vec2(0.0f, 0.0f);
  return revolution_intersect(ray, r, cone_equation(r, parameters.y), cone_equation(from_nearest(r), parameters.y), 0.0f, 1.0f,
                              parameters.x != 0.0f, uv.x);
}

bool cone_reject(Primitive s, Ray ray) { return false; }

void cone_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 cone_level(Primitive s, vec3 p) {
  float taper = object_parameters(s).y;
  vec3 q = point_into_object(s, p);
  float distance = maximum(sqrt(q.x * q.x + q.z * q.z), 1.0e-20f);
  return revolution_level(s, vec3(q.x / distance, taper, q.z / distance), distance - (1.0f - taper * q.y), q.y, 0.0f, 1.0f);
}

Surface cone_surface(Primitive s, Ray ray, Hit hit) {
  float taper = object_parameters(s).y;
  vec3 p = at_hit(object_ray(s, ray, 1.4142136f), hit);
  float radius = 1.0f - taper * minimum(maximum(p.y, 0.0f), 1.0f);
  return revolution_surface(s, ray, p, hit.uv.x, 0.0f, 0.0f, 1.0f, radius, -taper, taper * taper, hit.uv.x == PART_BOTTOM ? 1.0f : 1.0f - taper);
}

SHADER_END
#endif
