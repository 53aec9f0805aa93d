// From a hit to the surface there: asks the shape that was hit.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "ray.glsl"
#include "records.h"

SHADER_BEGIN

Surface surface_at(Primitive primitive, Ray ray, Hit hit) {
  Surface surface;
  surface.p = vec3(0.0f, 0.0f, 0.0f);
  surface.normal_geometric = vec3(0.0f, 0.0f, 0.0f);
  surface.normal = vec3(0.0f, 0.0f, 0.0f);
  surface.uv = vec2(0.0f, 0.0f);
  surface.offset = 0.0f;
#define SURFACE_OF(name, number) \
  if (primitive.head.x == number) surface = name##_surface(primitive, ray, hit);
  SHAPES(SURFACE_OF)
  return surface;
}

// The surface as its viewer sees it: normals towards where the ray came from.
Surface face_viewer(Surface surface, bool front) {
  Surface seen = surface;
  seen.normal_geometric = front ? surface.normal_geometric : -surface.normal_geometric;
  seen.normal = front ? surface.normal : -surface.normal;
  return seen;
}

SHADER_END
#endif
