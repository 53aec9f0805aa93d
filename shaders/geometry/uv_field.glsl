// Texture coordinates on a shape in its own space, and how they grow around a point.
#ifndef UV_FIELD_GLSL
#define UV_FIELD_GLSL
#include "math/math.glsl"

SHADER_BEGIN

struct UvField {
  vec2 uv;
  vec3 u_gradient;
  vec3 v_gradient;
};
UvField uv_field(vec2 uv, vec3 u_gradient, vec3 v_gradient) {
  UvField field;
  field.uv = uv;
  field.u_gradient = u_gradient;
  field.v_gradient = v_gradient;
  return field;
}

// The gradients of the u that runs once about the y axis, as on a globe, and of the angle from the lower
// pole.
vec3 turn_gradient(vec3 p) { return vec3(p.z, 0.0f, -p.x) / (2.0f * PI * maximum(p.x * p.x + p.z * p.z, 1.0e-20f)); }
vec3 pole_gradient(vec3 p) {
  float from_axis = sqrt(maximum(p.x * p.x + p.z * p.z, 1.0e-20f));
  return vec3(-p.y * p.x / from_axis, from_axis, -p.y * p.z / from_axis) / dot3(p, p);
}

SHADER_END
#endif
