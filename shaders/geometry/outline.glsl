// Outlines of straight edges, and whether a ray passes within one.
#ifndef OUTLINE_GLSL
#define OUTLINE_GLSL
#include "geometry/edges.glsl"
#include "records.h"

SHADER_BEGIN

// A vertex as seen along the ray: sheared into the plane across it, as in shapes/triangle.glsl, alike for all shapes; z is how far along.
vec3 seen_along(Ray ray, vec3 vertex) {
  vec3 v = permute(vertex - ray.o, ray.major);
  return vec3(v.x - ray.shear.x * v.z, v.y - ray.shear.y * v.z, v.z);
}

// True if the edge between p and q crosses the half line y = 0, x > 0 that starts at the ray. A ray passes within an outline whose edges do so an
// odd number of times. The answer is the same for q and p: their products are each other's exact negatives. So all shapes that have
// the edge take it alike, however it is rounded. A ray that passes within a patch of them passes within an odd
// number of them: never between.
bool crosses(vec3 p, vec3 q) {
  float side = p.x * q.y - p.y * q.x;
  return (p.y > 0.0f) != (q.y > 0.0f) && (q.y > p.y ? side > 0.0f : side < 0.0f);
}

// t of a plane, brought into where the ray is within `half_size` of `centre`, seen from its start; −1 where it is not, or t ≤ 0. It is for
// rays that graze the plane, and for BVHs, as in shapes/triangle.glsl: all points that rounding lets a ray hit are this close.
float t_within(Ray ray, float t, vec3 centre, vec3 half_size) {
  float room = 16.0f * EPSILON * max_component(abs3(centre) + half_size);
  vec3 middle = centre * ray.inverse;
  vec3 reach = abs3(ray.inverse) * (half_size + vec3(room, room, room));
  float entry = max_component(middle - reach);
  float exit = -max_component(-middle - reach);
  return t > 0.0f && entry <= exit ? minimum(maximum(t, entry), exit) : -1.0f;
}

SHADER_END
#endif
