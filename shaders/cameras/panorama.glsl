// All rays come from the eye: a picture of the sphere around it, longitude across and latitude up.
#ifndef PANORAMA_GLSL
#define PANORAMA_GLSL
#include "geometry/ray.glsl"
#include "math/trigonometry.glsl"
#include "records.h"

SHADER_BEGIN

// across: from the middle of the picture to a position in it: longitude by right, latitude by up.
Ray panorama_ray(Frame frame, vec3 across, vec2 lens) {
  vec3 u = normalize3(frame.right);
  vec3 v = normalize3(frame.up);
  vec2 around = sine_cosine(dot3(across, u));
  vec2 above = sine_cosine(dot3(across, v));
  vec3 level = u * around.x + frame.forward * around.y;
  return make_ray(vec3(0.0f, 0.0f, 0.0f), normalize3(level * above.y + v * above.x));
}

SHADER_END
#endif
