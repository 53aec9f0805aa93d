// All rays come from the eye; the picture is wrapped around it, and upright lines stay straight.
#ifndef CYLINDRICAL_GLSL
#define CYLINDRICAL_GLSL
#include "geometry/ray.glsl"
#include "math/trigonometry.glsl"
#include "records.h"

SHADER_BEGIN

// across: from the middle of the picture to a position in it: the angle by right, the height on a cylinder of radius 1 by up.
Ray cylindrical_ray(Frame frame, vec3 across, vec2 lens) {
  vec3 u = normalize3(frame.right);
  vec3 v = normalize3(frame.up);
  vec2 around = sine_cosine(dot3(across, u));
  vec3 level = u * around.x + frame.forward * around.y;
  return make_ray(vec3(0.0f, 0.0f, 0.0f), normalize3(level + v * dot3(across, v)));
}

SHADER_END
#endif
