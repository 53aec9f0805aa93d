// Quadrics that are round about the y axis of object space, between two planes across it: with caps, closed; without, sheets.
#ifndef REVOLUTION_GLSL
#define REVOLUTION_GLSL
#include "geometry/clipped_quadric.glsl"
#include "geometry/object_space.glsl"

SHADER_BEGIN

#define PART_SIDE 0.0f
#define PART_BOTTOM 1.0f
#define PART_TOP 2.0f

// Where the first boundary with t > 0 is of a quadric between the planes y = bottom and y = top; −1 if there is none. `part` says what it is. The equations are
// clipped_quadric's.
float revolution_intersect(Ray ray, ObjectRay r, vec3 equation, vec3 nearest_equation, float bottom, float top, bool open, OUT(float) part) {
  float inverse = bounded_inverse(r.d.y, 1.0e-12f * max_component(abs3(r.d)));
  float to_bottom = (bottom - r.o.y) * inverse;
  float to_top = (top - r.o.y) * inverse;
  float nearest = clipped_quadric(ray, r.t, equation, nearest_at(r), nearest_equation, minimum(to_bottom, to_top), maximum(to_bottom, to_top),
                                  open, part);
  part = part == PART_QUADRIC ? PART_SIDE : nearest == to_bottom ? PART_BOTTOM : PART_TOP;
  return nearest < T_MISS ? r.t + nearest : T_NONE;
}

// The surface at a point of a part. `radius` and `slope`: of the side at the height of p, and by how much it grows with y; `end_radius`: of a
// cap's rim. On the side u runs about the axis as on a globe and v from the bottom to the top; on caps, from the middle of the texture. What would be
// a cap without a rim is the side's tip.
Surface revolution_surface(Primitive s, vec3 p, float part, float bottom, float top, float radius, float slope,
                           float end_radius) {
  float distance = sqrt(p.x * p.x + p.z * p.z);
  vec3 gradient = vec3(0.0f, part == PART_BOTTOM ? -1.0f : 1.0f, 0.0f);
  UvField field = uv_field(vec2(0.0f, 0.0f), gradient, gradient);
  if (part == PART_SIDE || end_radius == 0.0f) {
    vec2 out_there = distance > 0.0f ? vec2(p.x / distance, p.z / distance) : vec2(1.0f, 0.0f);
    p = vec3(out_there.x * radius, minimum(maximum(p.y, bottom), top), out_there.y * radius);
    gradient = vec3(out_there.x, -slope, out_there.y);
    float u = 0.5f + atan_yx(-p.z, p.x) / (2.0f * PI);
    field = uv_field(vec2(u < 1.0f ? u : 0.0f, (p.y - bottom) / (top - bottom)), turn_gradient(p),
                     vec3(0.0f, 1.0f / (top - bottom), 0.0f));
  } else {
    float inside = distance > end_radius ? end_radius / distance : 1.0f;
    p = vec3(p.x * inside, part == PART_BOTTOM ? bottom : top, p.z * inside);
    field = uv_field(vec2(0.5f + 0.5f * p.x / end_radius, 0.5f - 0.5f * p.z / end_radius * gradient.y),
                     vec3(0.5f / end_radius, 0.0f, 0.0f), vec3(0.0f, 0.0f, -0.5f / end_radius * gradient.y));
  }
  return object_surface(s, p, gradient, field);
}

SHADER_END
#endif
