// What the entries do for one pixel: pixel → ray → colour, and pixel → ray → first hit.
#ifndef PIXEL_GLSL
#define PIXEL_GLSL
#include "camera.glsl"
#include "surface.glsl"
#include "traverse.glsl"

SHADER_BEGIN

SampleResult render_sample(Frame frame, uint x, uint y, uint index) {
  Ray ray = camera_ray(frame, sample_place(frame, x, y, index));
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  vec3 color = vec3(0.0f, 0.0f, 0.0f);
#define RADIANCE_OF(name, number) \
  if (frame.counts.z == number) color = name##_radiance(frame, ray, counts);
  INTEGRATORS(RADIANCE_OF)

  SampleResult result;
  result.color = vec4(positive_zeros(color), 1.0f);
  result.counts = counts;
  return result;
}

HitResult first_hit(Frame frame, uint x, uint y) {
  Ray ray = camera_ray(frame, vec2(float(x) + 0.5f, float(y) + 0.5f));
  Hit hit = trace(ray);
  HitResult result;
  result.position_t = vec4(0.0f, 0.0f, 0.0f, T_MISS);
  result.normal = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  result.uv = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  result.ids = uvec4(NONE, NONE, 0u, 0u);
  if (hit.primitive != NONE) {
    Primitive primitive = load_primitive(hit.primitive);
    Surface surface = surface_at(primitive, ray, hit);
    result.position_t = vec4(positive_zeros(surface.p), hit.t);
    result.normal = vec4(positive_zeros(surface.normal), 0.0f);
    result.uv = vec4(positive_zero(surface.uv.x), positive_zero(surface.uv.y), 0.0f, 0.0f);
    result.ids = uvec4(hit.primitive, primitive.head.y, 0u, 0u);
  }
  return result;
}

SHADER_END
#endif
