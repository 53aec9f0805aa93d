// The point of the lens at which a ray starts.
#ifndef LENS_GLSL
#define LENS_GLSL
#include "math/sampling.glsl"
#include "records.h"

SHADER_BEGIN

// Evenly on the polygon whose corners are on the circle of radius 1, the first of them `rotation` from the right. `u` chooses a point on
// its border, once around, and how far out it is.
vec2 on_polygon(vec2 u, uint corners, float rotation) {
  float along = u.x * float(corners);
  float side = floor(along);
  float angle = 2.0f * PI / float(corners);
  vec2 from = sine_cosine(rotation + angle * side);
  vec2 to = sine_cosine(rotation + angle * (side + 1.0f));
  vec2 border = from + (to - from) * (along - side);
  float out_there = sqrt(u.y);
  return vec2(border.y * out_there, border.x * out_there);
}

vec2 point_on_lens(Frame frame, vec2 u) {
  vec2 at = frame.blades == 0u ? on_disk(u) : on_polygon(u, frame.blades, frame.blade_rotation);
  return at * frame.aperture;
}

SHADER_END
#endif
