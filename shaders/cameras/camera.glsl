// Pixels to eye rays. The eye is the origin; the host has scaled the axes by field of view and aspect (docs/conventions.md).
#ifndef CAMERA_GLSL
#define CAMERA_GLSL
#include "geometry/ray.glsl"
#include "records.h"
#include "math/rng.glsl"

SHADER_BEGIN

// Where in the picture sample `index` of pixel (x, y) lies, in pixels from the top left: one of n × n cells, its centre or a
// random place in it.
vec2 sample_position(Frame frame, uint x, uint y, uint index) {
  uint n = frame.samples_per_side;
  uint pixel = y * frame.width + x;
  bool jittered = frame.pattern == PATTERN_JITTERED;
  float dx = jittered ? random_number(pixel, index, 0u, frame.seed) : 0.5f;
  float dy = jittered ? random_number(pixel, index, 1u, frame.seed) : 0.5f;
  return vec2(float(x) + (float(index % n) + dx) / float(n), float(y) + (float(index / n) + dy) / float(n));
}

Ray camera_ray(Frame frame, vec2 place) {
  float x = (place.x - 0.5f * float(frame.width)) * frame.pixel_width;
  float y = (0.5f * float(frame.height) - place.y) * frame.pixel_height;
  vec3 across = frame.right * x + frame.up * y;
  Ray ray = make_ray(across, frame.forward);
#define RAY_OF(name, number) \
  if (CAMERA_IS(number)) ray = name##_ray(frame, across);
  CAMERAS(RAY_OF)
  return ray;
}

SHADER_END
#endif
