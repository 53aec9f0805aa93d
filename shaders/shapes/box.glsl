// |x|, |y|, |z| ≤ 1 in object space (object_space.glsl).
#ifndef BOX_GLSL
#define BOX_GLSL
#include "object_space.glsl"

SHADER_BEGIN

// uv: the axis of the face, and its side.
float box_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  ObjectRay r = object_ray(s, ray, 1.7320508f);

  // Three slabs, of which the ray is inside from `near` to `far`. A finite inverse keeps 0 · ∞ away.
  float least = 1.0e-12f * max_component(abs3(r.d));
  vec3 inverse = vec3(bounded_inverse(r.d.x, least), bounded_inverse(r.d.y, least), bounded_inverse(r.d.z, least));
  vec3 a = (vec3(-1.0f, -1.0f, -1.0f) - r.o) * inverse;
  vec3 b = (vec3(1.0f, 1.0f, 1.0f) - r.o) * inverse;
  vec3 in_at = vec3(minimum(a.x, b.x), minimum(a.y, b.y), minimum(a.z, b.z));
  vec3 out_at = vec3(maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z));
  float near = max_component(in_at);
  float far = minimum(minimum(out_at.x, out_at.y), out_at.z);
  bool enters = r.t + near > 0.0f;

  // The face is that of the slab which decides, not of the point: near an edge that would be either, also one that faces away.
  float x = enters ? in_at.x - near : far - out_at.x;
  float y = enters ? in_at.y - near : far - out_at.y;
  uv.x = x == 0.0f ? 0.0f : y == 0.0f ? 1.0f : 2.0f;
  float along = uv.x == 0.0f ? r.d.x : uv.x == 1.0f ? r.d.y : r.d.z;
  uv.y = (along > 0.0f) == enters ? -1.0f : 1.0f;
  return near <= far ? r.t + (enters ? near : far) : -1.0f;
}

bool box_may_hit(Primitive s, Ray ray) { return true; }

void box_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

Surface box_surface(Primitive s, Ray ray, Hit hit) {
  // Onto the face. Seen from outside u runs to the right and v up; what is up on top is −z, below +z.
  vec3 p = at_hit(object_ray(s, ray, 1.7320508f), hit);
  p = vec3(minimum(maximum(p.x, -1.0f), 1.0f), minimum(maximum(p.y, -1.0f), 1.0f), minimum(maximum(p.z, -1.0f), 1.0f));
  float side = hit.uv.y;
  vec3 gradient = vec3(0.0f, 0.0f, 0.0f);
  vec2 uv = vec2(0.0f, 0.0f);
  if (hit.uv.x == 0.0f) {
    p.x = side;
    gradient.x = side;
    uv = vec2(-p.z * side, p.y);
  } else if (hit.uv.x == 1.0f) {
    p.y = side;
    gradient.y = side;
    uv = vec2(p.x, -p.z * side);
  } else {
    p.z = side;
    gradient.z = side;
    uv = vec2(p.x * side, p.y);
  }
  return object_surface(s, p, gradient, uv * 0.5f + vec2(0.5f, 0.5f));
}

SHADER_END
#endif
