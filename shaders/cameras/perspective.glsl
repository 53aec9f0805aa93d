// All rays come from the eye, which is the origin.
#ifndef PERSPECTIVE_GLSL
#define PERSPECTIVE_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// across: from the middle of the picture to a place in it, on the plane that `forward` ends on.
Ray perspective_ray(Frame frame, vec3 across) {
  return make_ray(vec3(0.0f, 0.0f, 0.0f), normalize3(across + frame.forward));
}

SHADER_END
#endif
