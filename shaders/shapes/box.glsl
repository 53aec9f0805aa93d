// |x|, |y|, |z| ≤ 1 in object space (geometry/object_space.glsl).
#ifndef BOX_GLSL
#define BOX_GLSL
#include "geometry/cube.glsl"

SHADER_BEGIN

#define BOX_REACH 1.7320508f

// uv: the axis of the face, and its side.
float box_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  ObjectRay r = object_ray(s, ray, BOX_REACH);
  CubeSpan span = cube_span(r);
  bool enters = ENTERS(ray, r.t + span.enter);
  uv = cube_face(span, r, enters);
  return span.enter <= span.leave ? r.t + (enters ? span.enter : span.leave) : T_NONE;
}

bool box_reject(Primitive s, Ray ray) { return false; }

void box_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 box_level(Primitive s, vec3 p) {
  return cube_level(s, point_into_object(s, p));
}

Surface box_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = onto_cube(at_hit(object_ray(s, ray, BOX_REACH), hit), hit.uv);
  Surface surface = object_surface(s, p, cube_normal(hit.uv), cube_uv(p, hit.uv));
  float room = object_room(s, ray, p, surface.offset);
  surface.inward = step_out_of_object(s, inward_of_cube(p, hit.uv, coordinate_steepness(s) * room));
  return surface;
}

SHADER_END
#endif
