// Colours of surfaces themselves, by which the colours of their materials are multiplied.
#ifndef OWN_COLOR_GLSL
#define OWN_COLOR_GLSL
#include "geometry/ray.glsl"
#include "records.h"
#if HAS_COLORS
#include "shapes/points.glsl"
#endif

SHADER_BEGIN

#if HAS_COLORS
// The factor for the material's colour from a mesh's vertices, or from a point; white if they have none, and on other shapes.
vec3 own_color(Primitive s, Hit hit) {
  if (kind_of(s) == KIND_points) return points_color(s);
  if (kind_of(s) != KIND_triangle || s.extra == NONE) return vec3(1.0f, 1.0f, 1.0f);
  uvec4 corners = load_vertex(s.extra);
  if ((corners.w & CORNERS_COLORS) == 0u) return vec3(1.0f, 1.0f, 1.0f);
  vec3 a = vec3(bits_to_floats(load_vertex(corners.x + 1u)));
  vec3 b = vec3(bits_to_floats(load_vertex(corners.y + 1u)));
  vec3 c = vec3(bits_to_floats(load_vertex(corners.z + 1u)));
  return (a * ((1.0f - hit.uv.x) - hit.uv.y) + b * hit.uv.x) + c * hit.uv.y;
}

// The alpha of a mesh's vertices; 1 if they have none, and on other shapes. Where all three are equal, that very value.
float vertex_alpha(Primitive s, vec2 uv) {
  if (kind_of(s) != KIND_triangle || s.extra == NONE) return 1.0f;
  uvec4 corners = load_vertex(s.extra);
  if ((corners.w & CORNERS_COLORS) == 0u) return 1.0f;
  float a = bits_to_floats(load_vertex(corners.x + 1u)).w;
  float b = bits_to_floats(load_vertex(corners.y + 1u)).w;
  float c = bits_to_floats(load_vertex(corners.z + 1u)).w;
  return (a + (b - a) * uv.x) + (c - a) * uv.y;
}
#endif

SHADER_END
#endif
