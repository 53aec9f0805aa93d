// Planes have no edges, and cut all objects that they pass through: a spawned ray stays on the side of each from which its parent came.
#ifndef CLEAR_OF_PLANES_GLSL
#define CLEAR_OF_PLANES_GLSL
#include "geometry/edges.glsl"
#include "records.h"
#include "shapes/plane.glsl"

SHADER_BEGIN

// `inward` of a surface in the world that `ray` has hit, with the part that plane `s` adds if it is that near.
vec3 inward_of_plane(Primitive s, Surface surface, Ray ray) {
  vec3 n = plane_normal(s);
  float room = edge_room(ray, 3.0f * max_component(abs3(surface.p)) + abs(plane_distance(s)), surface.offset);
  float value = dot3(n, surface.p) - plane_distance(s);
  bool below = dot3(n, ray.o) < plane_distance(s);
  if (abs(value) >= room) return surface.inward;
  return inward_of_face(surface.inward, surface.normal_geometric, below ? value : -value, below ? n : -n, room);
}

// `slot`: that of the primitive that was hit.
Surface clear_of_planes(Surface surface, Ray ray, uint slot) {
  Surface clear = surface;
#ifdef SCENE_PRIMITIVES
#define CLEAR_OF(name, index, constants) \
  if (kind_of(constants) == KIND_plane && slot != index) clear.inward = inward_of_plane(constants, clear, ray);
  SCENE_PRIMITIVES(CLEAR_OF)
#else
  if (KIND_FIRST(plane) < KIND_END(plane))
    for (uint i = KIND_FIRST(plane); i < KIND_END(plane); i++)
      if (i != slot) clear.inward = inward_of_plane(load_primitive(i), clear, ray);
#endif
  return clear;
}

SHADER_END
#endif
