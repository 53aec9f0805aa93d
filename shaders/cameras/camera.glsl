// Pixels to eye rays. The eye is the origin; the host has scaled the axes by field of view and aspect (docs/conventions.md).
#ifndef CAMERA_GLSL
#define CAMERA_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// place: in pixels from the top left.
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
