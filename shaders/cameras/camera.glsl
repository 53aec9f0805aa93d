// Maps pixels to camera rays. The eye is the origin; the host has scaled the axes by field of view and aspect
// (docs/conventions.md).
#ifndef CAMERA_GLSL
#define CAMERA_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// `position`: in pixels from the top left.
vec3 across_picture(Frame frame, vec2 position) {
  float x = (position.x - 0.5f * float(frame.width)) * frame.pixel_width;
  float y = (0.5f * float(frame.height) - position.y) * frame.pixel_height;
  return frame.right * x + frame.up * y;
}

// lens: the point of the lens that the ray starts from, to the right and up of its middle.
Ray camera_ray(Frame frame, vec2 position, vec2 lens) {
  vec3 across = across_picture(frame, position);
  Ray ray = make_ray(across, frame.forward);
#define RAY_OF(name, number, seen) \
  if (CAMERA_IS(number)) ray = name##_ray(frame, across, lens);
  CAMERAS(RAY_OF)
  return ray;
}

#define SEEN_IN_picture(name, across, lens) true
#define SEEN_IN_circle(name, across, lens) (dot3(across, across) <= dot3(frame.forward, frame.forward))
#define SEEN_IN_itself(name, across, lens) name##_sees(frame, across, lens)
// True if anything is seen there; else the picture is black, and there is no ray.
bool camera_sees(Frame frame, vec2 position, vec2 lens) {
  vec3 across = across_picture(frame, position);
  bool sees = true;
#define SEEN_OF(name, number, seen) \
  if (CAMERA_IS(number)) sees = SEEN_IN_##seen(name, across, lens);
  CAMERAS(SEEN_OF)
  return sees;
}

SHADER_END
#endif
