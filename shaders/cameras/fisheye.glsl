// All rays come from the eye; the angle of a point is its distance from the middle. |forward| is the angle of the circle's rim.
#ifndef FISHEYE_GLSL
#define FISHEYE_GLSL
#include "geometry/ray.glsl"
#include "math/trigonometry.glsl"
#include "records.h"

SHADER_BEGIN

// across: from the middle of the picture to a position in it, as long as the angle between its ray and the middle's.
Ray fisheye_ray(Frame frame, vec3 across, vec2 lens) {
  float angle = sqrt(dot3(across, across));
  vec2 turn = sine_cosine(angle);
  vec3 radial = across * (angle > 0.0f ? turn.x / angle : 1.0f);
  return make_ray(vec3(0.0f, 0.0f, 0.0f), normalize3(radial + normalize3(frame.forward) * turn.y));
}

SHADER_END
#endif
