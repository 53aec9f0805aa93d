// The cube from −1 to 1 in object space (geometry/object_space.glsl): a box, or the cutter of another shape.
#ifndef CUBE_GLSL
#define CUBE_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

// The part of a ray inside of the three slabs: from its entry into the last to its exit from the first; empty if enter > leave.
struct CubeSpan {
  vec3 in_at;
  vec3 out_at;
  float enter;
  float leave;
};

CubeSpan cube_span(ObjectRay r) {
  // A finite inverse keeps 0 · ∞ away.
  float least = 1.0e-12f * max_component(abs3(r.d));
  vec3 inverse = vec3(bounded_inverse(r.d.x, least), bounded_inverse(r.d.y, least), bounded_inverse(r.d.z, least));
  vec3 a = (vec3(-1.0f, -1.0f, -1.0f) - r.o) * inverse;
  vec3 b = (vec3(1.0f, 1.0f, 1.0f) - r.o) * inverse;
  CubeSpan span;
  span.in_at = vec3(minimum(a.x, b.x), minimum(a.y, b.y), minimum(a.z, b.z));
  span.out_at = vec3(maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z));
  span.enter = max_component(span.in_at);
  span.leave = minimum(minimum(span.out_at.x, span.out_at.y), span.out_at.z);
  return span;
}

// The face through which the ray enters or leaves: its axis, and its side. It is that of the slab which decides, not of the point: near an
// edge that would be either, also one that faces away.
vec2 cube_face(CubeSpan span, ObjectRay r, bool enters) {
  float x = enters ? span.in_at.x - span.enter : span.leave - span.out_at.x;
  float y = enters ? span.in_at.y - span.enter : span.leave - span.out_at.y;
  float axis = x == 0.0f ? 0.0f : y == 0.0f ? 1.0f : 2.0f;
  float along = axis == 0.0f ? r.d.x : axis == 1.0f ? r.d.y : r.d.z;
  return vec2(axis, (along > 0.0f) == enters ? -1.0f : 1.0f);
}

vec3 cube_normal(vec2 face) {
  return vec3(face.x == 0.0f ? face.y : 0.0f, face.x == 1.0f ? face.y : 0.0f, face.x == 2.0f ? face.y : 0.0f);
}

vec3 into_cube(vec3 p) {
  return vec3(minimum(maximum(p.x, -1.0f), 1.0f), minimum(maximum(p.y, -1.0f), 1.0f), minimum(maximum(p.z, -1.0f), 1.0f));
}

vec3 onto_cube(vec3 p, vec2 face) {
  vec3 q = into_cube(p);
  return vec3(face.x == 0.0f ? face.y : q.x, face.x == 1.0f ? face.y : q.y, face.x == 2.0f ? face.y : q.z);
}

// The level of the cube at the point q of object space.
vec4 cube_level(Primitive s, vec3 q) {
  vec3 side = vec3(q.x < 0.0f ? -1.0f : 1.0f, q.y < 0.0f ? -1.0f : 1.0f, q.z < 0.0f ? -1.0f : 1.0f);
  vec4 x = level_out_of_object(s, vec3(side.x, 0.0f, 0.0f), abs(q.x) - 1.0f);
  vec4 y = level_out_of_object(s, vec3(0.0f, side.y, 0.0f), abs(q.y) - 1.0f);
  vec4 z = level_out_of_object(s, vec3(0.0f, 0.0f, side.z), abs(q.z) - 1.0f);
  return outer_level(x, outer_level(y, z));
}

// From a point on a face to the inside of that face's edges; `margins`: how far inside in each coordinate.
vec3 inward_of_cube(vec3 p, vec2 face, vec3 margins) {
  vec3 inner = vec3(inside_ends(p.x, -1.0f, 1.0f, margins.x), inside_ends(p.y, -1.0f, 1.0f, margins.y),
                    inside_ends(p.z, -1.0f, 1.0f, margins.z)) - p;
  return vec3(face.x == 0.0f ? 0.0f : inner.x, face.x == 1.0f ? 0.0f : inner.y, face.x == 2.0f ? 0.0f : inner.z);
}

// From p, on a face of the cube, to the inside of its edges and of a surface within the cube that has `value` and `gradient` there, as inward_of_face.
vec3 inward_of_cut_face(Primitive s, vec3 p, vec2 face, float value, vec3 gradient, float room) {
  vec3 inward = inward_of_cube(p, face, coordinate_steepness(s) * room);
  float squared = dot3(gradient, gradient);
  vec3 along = gradient - cube_normal(face) * dot3(cube_normal(face), gradient);
  float missing = (value + dot3(gradient, inward)) + room * steepness(s, gradient);
  return missing > 0.0f && squared > 0.0f ? inward - along * (missing / maximum(dot3(along, along), 0.015625f * squared)) : inward;
}

// From p, on that surface, to the inside of the cube's faces.
vec3 inward_of_cut(Primitive s, vec3 p, vec3 gradient, float room) {
  float squared = dot3(gradient, gradient);
  vec3 n = squared > 0.0f ? gradient / sqrt(squared) : vec3(0.0f, 0.0f, 0.0f);
  vec3 margins = coordinate_steepness(s) * room;
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  for (uint axis = 0u; axis < 3u; axis++) {
    vec3 outward = vec3(axis == 0u ? 1.0f : 0.0f, axis == 1u ? 1.0f : 0.0f, axis == 2u ? 1.0f : 0.0f);
    float at = dot3(outward, p + inward);
    float step = inside_ends(at, -1.0f, 1.0f, dot3(outward, margins)) - at;
    vec3 along = outward - n * dot3(n, outward);
    inward = inward + along * (step / maximum(dot3(along, along), 0.015625f));
  }
  return inward;
}

// Seen from outside u runs to the right and v up. On the top face up is −z, on the bottom +z.
UvField cube_uv(vec3 p, vec2 face) {
  float u = face.x == 0.0f ? -p.z * face.y : face.x == 1.0f ? p.x : p.x * face.y;
  float v = face.x == 1.0f ? -p.z * face.y : p.y;
  vec3 right = vec3(face.x == 0.0f ? 0.0f : face.x == 1.0f ? 0.5f : 0.5f * face.y, 0.0f, face.x == 0.0f ? -0.5f * face.y : 0.0f);
  vec3 upward = vec3(0.0f, face.x == 1.0f ? 0.0f : 0.5f, face.x == 1.0f ? -0.5f * face.y : 0.0f);
  return uv_field(inner_uv(vec2(0.5f + 0.5f * u, 0.5f + 0.5f * v)), right, upward);
}

SHADER_END
#endif
