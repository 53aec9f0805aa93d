// Spawned rays start inside of a surface's edges. There the neighbour is closer than rounding can resolve: a start that is put off one face
// (spawn_ray) may lie behind the other, and nothing would stop its ray (docs/numerics.md).
#ifndef EDGES_GLSL
#define EDGES_GLSL
#include "geometry/ray.glsl"

SHADER_BEGIN

// The distance inside of edges at which rays start on a surface, at least 16 of its `offset`s: spawn_ray displaces a start sideways by at most 8. The
// rest is for faces that enclose a small angle.
float edge_room(Ray ray, float reach, float offset) {
#if HAS_INSTANCES
  reach = reach + ray.reach;
#endif
  return maximum(128.0f * EPSILON * reach, 16.0f * offset);
}

// x, brought inside of `low` and `high` by `room`; between them where there is less.
float inside_ends(float x, float low, float high, float room) {
  float least = minimum(room, 0.5f * (high - low));
  return minimum(maximum(x, low + least), high - least);
}

// The step that brings (u, v), of a surface that is 1 wide, inside of its four edges. The surface has the gradients of u and v.
vec2 inner_step(Surface surface, vec2 uv, float room) {
  return vec2(inside_ends(uv.x, 0.0f, 1.0f, room * sqrt(dot3(surface.u_gradient, surface.u_gradient))),
              inside_ends(uv.y, 0.0f, 1.0f, room * sqrt(dot3(surface.v_gradient, surface.v_gradient)))) - uv;
}

// `inward`, a displacement along a surface, plus the part missing to value + gradient · displacement ≤ −room · |gradient|: then the start
// is on the inner side of another surface, and clear of it. That part goes along the edge from which `inward` moves away, if any.
// `n`: the unit normal of the surface itself.
vec3 inward_of_face(vec3 inward, vec3 n, float value, vec3 gradient, float room) {
  float squared = dot3(gradient, gradient);
  float missing = (value + dot3(gradient, inward)) + room * sqrt(squared);
  vec3 along = gradient - n * dot3(gradient, n);
  float moved = dot3(inward, inward);
  if (moved > 0.0f) along = along - inward * (dot3(along, inward) / moved);
  return missing > 0.0f ? inward - along * (missing / maximum(dot3(along, along), 0.015625f * squared)) : inward;
}

SHADER_END
#endif
