// Within 1 of the y axis between −half and half, in object space (geometry/object_space.glsl).   parameters: half
#ifndef CAPSULE_GLSL
#define CAPSULE_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

// The t at which the ray enters (side = −1) or leaves (1) the ball around the end on the side of y. T_MISS if it does not.
float capsule_end(ObjectRay r, float end, float side) {
  vec3 o = vec3(r.o.x, r.o.y - end, r.o.z);
  float squared = dot3(r.d, r.d);
  float middle = -dot3(o, r.d) / squared;
  vec3 nearest = o + r.d * middle;
  float discriminant = 1.0f - dot3(nearest, nearest);
  return discriminant >= 0.0f ? middle + side * sqrt(discriminant / squared) : T_MISS;
}

// A ray enters and leaves once. Where it passes the endless cylinder beyond an end, it is the ball around that end that counts.
float capsule_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  float half_length = object_parameters(s).x;
  ObjectRay r = object_ray(s, ray, half_length + 1.0f);
  float across = maximum(r.d.x * r.d.x + r.d.z * r.d.z, 1.0e-16f * dot3(r.d, r.d));
  float middle = -(r.o.x * r.d.x + r.o.z * r.d.z) / across;
  float x = r.o.x + r.d.x * middle;
  float z = r.o.z + r.d.z * middle;
  float discriminant = 1.0f - (x * x + z * z);
  float root = sqrt(maximum(discriminant, 0.0f) / across);
  float enter = middle - root;
  float leave = middle + root;
  float enter_y = r.o.y + r.d.y * enter;
  float leave_y = r.o.y + r.d.y * leave;
  float first = capsule_end(r, enter_y < 0.0f ? -half_length : half_length, -1.0f);
  float second = capsule_end(r, leave_y < 0.0f ? -half_length : half_length, 1.0f);
  enter = abs(enter_y) > half_length ? first : enter;
  leave = abs(leave_y) > half_length ? second : leave;
  float t = ENTERS(ray, r.t + enter) ? enter : leave;
  return discriminant >= 0.0f && t < T_MISS ? r.t + t : T_NONE;
}

bool capsule_reject(Primitive s, Ray ray) { return false; }

void capsule_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, object_parameters(s).x + 1.0f, 1.0f), lower, upper); }

vec4 capsule_level(Primitive s, vec3 p) {
  float half_length = object_parameters(s).x;
  vec3 q = point_into_object(s, p);
  q.y = q.y - minimum(maximum(q.y, -half_length), half_length);
  return level_out_of_object(s, q, 0.5f * (dot3(q, q) - 1.0f));
}

Surface capsule_surface(Primitive s, Ray ray, Hit hit) {
  float half_length = object_parameters(s).x;
  vec3 p = at_hit(object_ray(s, ray, half_length + 1.0f), hit);
  float y = minimum(maximum(p.y, -half_length), half_length);
  vec3 n = vec3(p.x, p.y - y, p.z);
  n = dot3(n, n) > 0.0f ? normalize3(n) : vec3(1.0f, 0.0f, 0.0f);

  // v is the length of the way from the lower pole.
  float u = 0.5f + atan_yx(-n.z, n.x) / (2.0f * PI);
  float way = atan_yx(sqrt(n.x * n.x + n.z * n.z), -n.y) + (y + half_length);
  float whole = PI + 2.0f * half_length;
  return object_surface(s, n + vec3(0.0f, y, 0.0f), n,
                        uv_field(vec2(u < 1.0f ? u : 0.0f, way / whole), turn_gradient(n), pole_gradient(n) / whole));
}

SHADER_END
#endif
