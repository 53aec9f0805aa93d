// Rays and what they meet.
#ifndef RAY_GLSL
#define RAY_GLSL
#include "math.glsl"

SHADER_BEGIN

// P(t) = o + t·d. The rest is Woop's shear, the same for every triangle (shapes/triangle.glsl).
struct Ray {
  vec3 o;
  vec3 d;
  uint major;  // the axis along which d is longest
  vec2 shear;
};

struct Hit {
  float t;         // T_MISS where nothing is hit
  uint primitive;  // NONE where nothing is hit
  vec2 uv;         // the shape's own parameters
};

// What a shape says of the point that was hit.
struct Surface {
  vec3 p;                 // on the surface, projected
  vec3 normal_geometric;  // unit; outward, or by winding
  vec3 normal;            // unit shading normal
  vec2 uv;
  float offset;  // a ray that starts this far off p along the geometric normal does not meet the surface again
};

// The last two axes after `major`, then `major` itself.
vec3 permute(vec3 v, uint major) {
  return major == 0u ? vec3(v.y, v.z, v.x) : major == 1u ? vec3(v.z, v.x, v.y) : v;
}

Ray make_ray(vec3 o, vec3 d) {
  Ray ray;
  ray.o = o;
  ray.d = d;
  vec3 size = abs3(d);
  ray.major = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
  vec3 p = permute(d, ray.major);
  ray.shear = vec2(p.x / p.z, p.y / p.z);
  return ray;
}

// A ray that leaves `s` in direction d, started clear of the surface on the side that d points to. Where d is steep enough the start
// moves along the ray itself, which keeps its line: a step along the normal would shift every refracted ray sideways.
Ray leave(Surface s, vec3 d) {
  float cosine = dot3(d, s.normal_geometric);
  float side = cosine < 0.0f ? -s.offset : s.offset;
  bool steep = abs(cosine) > 0.125f;
  return make_ray(s.p + (steep ? d * (s.offset / abs(cosine)) : s.normal_geometric * side), d);
}

SHADER_END
#endif
