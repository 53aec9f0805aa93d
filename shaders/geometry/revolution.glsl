// Quadrics of revolution about the y axis of object space, between two planes across it: with caps, closed; without, sheets.
#ifndef REVOLUTION_GLSL
#define REVOLUTION_GLSL
#include "geometry/clipped_quadric.glsl"
#include "geometry/object_space.glsl"

SHADER_BEGIN

#define PART_SIDE 0.0f
#define PART_BOTTOM 1.0f
#define PART_TOP 2.0f

// The t > 0 of the first boundary of a quadric between the planes y = bottom and y = top; −1 if there is none. `part` identifies the boundary. The
// equations are clipped_quadric's.
float revolution_intersect(Ray ray, ObjectRay r, vec3 equation, vec3 nearest_equation, float bottom, float top, bool open, OUT(float) part) {
  float inverse = bounded_inverse(r.d.y, 1.0e-12f * max_component(abs3(r.d)));
  float to_bottom = (bottom - r.o.y) * inverse;
  float to_top = (top - r.o.y) * inverse;
  float nearest = clipped_quadric(ray, r.t, equation, nearest_at(r), nearest_equation, minimum(to_bottom, to_top), maximum(to_bottom, to_top),
                                  open, part);
  part = part == PART_QUADRIC ? PART_SIDE : nearest == to_bottom ? PART_BOTTOM : PART_TOP;
  return nearest < T_MISS ? r.t + nearest : T_NONE;
}

// The level of a side that has `gradient` and `value` at the height y, between the planes of its caps.
vec4 revolution_level(Primitive s, vec3 gradient, float value, float y, float bottom, float top) {
  vec4 below = level_out_of_object(s, vec3(0.0f, -1.0f, 0.0f), bottom - y);
  vec4 above = level_out_of_object(s, vec3(0.0f, 1.0f, 0.0f), y - top);
  return outer_level(level_out_of_object(s, gradient, value), outer_level(below, above));
}

// From a point of the side to the inside of its rims, up or down the side. `gradient`: (outward, −slope); `square`: of y² in the square of the side's
// radius. Near a tip that leads down to where the side is so wide that a tangent 8 offsets long ends less than one above it.
vec3 inward_of_side(Primitive s, vec3 p, vec3 gradient, float radius, float square, float bottom, float top, float room) {
  float slope = -gradient.y;
  float rise = inside_ends(p.y, bottom, top, room * coordinate_steepness(s).y) - p.y;
  float least = 4.0f * room * steepness(s, vec3(-gradient.x, gradient.y, -gradient.z));
  float narrow = radius + slope * rise - least;
  if (slope < 0.0f && narrow < 0.0f) rise = maximum(rise - narrow / slope, bottom - p.y);
  float wider = sqrt(maximum((radius + 2.0f * slope * rise) * radius + square * rise * rise, 0.0f)) - radius;
  return vec3(gradient.x * wider, rise, gradient.z * wider);
}

// From a point of a cap to the inside of its rim. `slope`: by how much the side's radius grows there with y.
vec3 inward_of_rim(Primitive s, vec3 p, float radius, float slope, float room) {
  float distance = sqrt(p.x * p.x + p.z * p.z);
  if (!(distance > 0.0f)) return vec3(0.0f, 0.0f, 0.0f);
  vec2 out_there = vec2(p.x / distance, p.z / distance);
  float margin = room * steepness(s, vec3(out_there.x, -slope, out_there.y));
  float step = minimum(maximum(radius - margin, 0.0f) - distance, 0.0f);
  return vec3(out_there.x * step, 0.0f, out_there.y * step);
}

// The surface at a point of a part. `radius` and `slope`: of the side at the height of p, and by how much it grows with y. `square`: of y² in the radius' square. `end_radius`: of a
// cap's rim. `rim`: where the lower one is, below `bottom` where the side ends in a rounded tip. On the side u runs about the axis as on a globe and
// v from the bottom to the top; on caps, from the middle of the texture. A cap without a rim is the side's tip.
Surface revolution_surface(Primitive s, Ray ray, vec3 p, float part, float rim, float bottom, float top, float radius, float slope,
                           float square, float end_radius) {
  float distance = sqrt(p.x * p.x + p.z * p.z);
  vec3 gradient = vec3(0.0f, part == PART_BOTTOM ? -1.0f : 1.0f, 0.0f);
  UvField field = uv_field(vec2(0.0f, 0.0f), gradient, gradient);
  bool side = part == PART_SIDE || end_radius == 0.0f;
  if (side) {
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
  Surface surface = object_surface(s, p, gradient, field);
  float room = object_room(s, ray, p, surface.offset);
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  if (side)
    inward = inward_of_side(s, p, gradient, radius, square, rim, top, room);
  else
    inward = inward_of_rim(s, p, end_radius, slope, room);
  surface.inward = step_out_of_object(s, inward);
  return surface;
}

SHADER_END
#endif
