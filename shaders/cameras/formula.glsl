// Rays by a function of the scene's, in the camera's own axes.
#ifndef CAMERAS_FORMULA_GLSL
#define CAMERAS_FORMULA_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// The function's arguments. across: from the middle of the picture to a point in it, by right and up, in half widths.
vec4 formula_arguments(Frame frame, vec3 across, vec2 lens) {
  return vec4(dot3(across, normalize3(frame.right)), dot3(across, normalize3(frame.up)), lens.x, lens.y);
}
vec3 formula_out(Frame frame, vec3 v) { return normalize3(frame.right) * v.x + normalize3(frame.up) * v.y + frame.forward * v.z; }

// A formula may return anything: invalid directions, and origins beyond the extent of all scenes, see nothing.
bool formula_sees(Frame frame, vec3 across, vec2 lens) {
  vec4 arguments = formula_arguments(frame, across, lens);
  vec3 d = FORMULA_DIRECTION(frame.camera_formula, arguments);
  vec3 o = abs3(FORMULA_ORIGIN(frame.camera_formula, arguments));
  float squared = dot3(d, d);
  return squared > 1.0e-30f && squared < 1.0e30f && o.x <= 1.0e12f && o.y <= 1.0e12f && o.z <= 1.0e12f;
}

Ray formula_ray(Frame frame, vec3 across, vec2 lens) {
  vec4 arguments = formula_arguments(frame, across, lens);
  bool sees = formula_sees(frame, across, lens);
  vec3 d = sees ? FORMULA_DIRECTION(frame.camera_formula, arguments) : vec3(0.0f, 0.0f, 1.0f);
  vec3 o = sees ? FORMULA_ORIGIN(frame.camera_formula, arguments) : vec3(0.0f, 0.0f, 0.0f);
  return make_ray(formula_out(frame, o), formula_out(frame, normalize3(d)));
}

SHADER_END
#endif
