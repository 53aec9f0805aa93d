// All rays come from the eye, which is the origin, or from a lens around it. Rays of one point in the picture intersect in the plane in
// focus.
#ifndef PERSPECTIVE_GLSL
#define PERSPECTIVE_GLSL
#include "geometry/ray.glsl"
#include "kernels/features.h"
#include "records.h"

SHADER_BEGIN

// across: from the middle of the picture to a position in it, on the plane that `forward` ends on.
Ray perspective_ray(Frame frame, vec3 across, vec2 lens) {
  vec3 start = vec3(0.0f, 0.0f, 0.0f);
  vec3 way = across + frame.forward;
  if (HAS_LENS == 1 && frame.aperture > 0.0f) {
    start = normalize3(frame.right) * lens.x + normalize3(frame.up) * lens.y;
    way = way - start * frame.sharpness;
  }
  return make_ray(start, normalize3(way));
}

SHADER_END
#endif
