// The distance from a smooth triangle at which its scattered rays start: Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II
// (2021), chapter 4. A shadow ray from the flat triangle would hit the mesh that only looks curved, and whole facets would be black near the
// terminator.
#ifndef LIFT_GLSL
#define LIFT_GLSL
#include "geometry/corners.glsl"
#include "geometry/instance.glsl"
#include "records.h"

SHADER_BEGIN

#if HAS_SMOOTH
#define MOST_LIFT 0.25f  // the largest lift, as a share of the longest edge

// The point lies at these heights above the planes through the corners perpendicular to their normals. `x`: how far it is below them, y:
// how far above, both averaged by its weights, along the interpolated normal and in the primitive's own space. −1: no smooth triangle.
vec2 lift_of(Primitive s, vec2 uv) {
  vec2 none = vec2(-1.0f, -1.0f);
  if (kind_of(s) != KIND_triangle || s.extra == NONE) return none;
  uvec4 corners = load_vertex(s.extra);
  if ((corners.w & CORNERS_NORMALS) == 0u) return none;
  vec3 n0 = vec3(bits_to_floats(load_vertex(corners.x)));
  vec3 n1 = vec3(bits_to_floats(load_vertex(corners.y)));
  vec3 n2 = vec3(bits_to_floats(load_vertex(corners.z)));
  vec3 to_b = corner_b(s) - corner_a(s);
  vec3 to_c = corner_c(s) - corner_a(s);
  float wa = (1.0f - uv.x) - uv.y;
  vec3 from_a = to_b * uv.x + to_c * uv.y;
  float a = wa * dot3(from_a, n0);
  float b = uv.x * dot3(from_a - to_b, n1);
  float c = uv.y * dot3(from_a - to_c, n2);
  vec3 n = (n0 * wa + n1 * uv.x) + n2 * uv.y;
  float size = sqrt(dot3(n, n));
  float above = (maximum(a, 0.0f) + maximum(b, 0.0f)) + maximum(c, 0.0f);
  float below = (maximum(-a, 0.0f) + maximum(-b, 0.0f)) + maximum(-c, 0.0f);
  return vec2(below / size, above / size);
}

// The bound keeps rays of triangles with wild normals near them. An icosahedron needs less.
vec2 bounded_lift(vec2 lift, Primitive s, uint instance) {
  vec3 to_b = corner_b(s) - corner_a(s);
  vec3 to_c = corner_c(s) - corner_a(s);
#if HAS_INSTANCES
  if (instance != NONE) {
    Instance map = load_instance(instance);
    to_b = map_direction(map.to_world, to_b);
    to_c = map_direction(map.to_world, to_c);
  }
#endif
  vec3 b_to_c = to_c - to_b;
  float most = MOST_LIFT * sqrt(maximum(dot3(b_to_c, b_to_c), maximum(dot3(to_b, to_b), dot3(to_c, to_c))));
  return vec2(minimum(lift.x, most), minimum(lift.y, most));
}
#endif

SHADER_END
#endif
