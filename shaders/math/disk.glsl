// Evenly on a disk.
#ifndef MATH_DISK_GLSL
#define MATH_DISK_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

// On the disk of radius 1, by squares within squares: Shirley and Chiu, "A Low Distortion Map Between Disk and Square" (1997).
vec2 on_disk(vec2 u) {
  float x = 2.0f * u.x - 1.0f;
  float y = 2.0f * u.y - 1.0f;
  bool wide = abs(x) > abs(y);
  float radius = wide ? x : y;
  float angle = radius == 0.0f ? 0.0f : wide ? 0.25f * PI * (y / x) : 0.5f * PI - 0.25f * PI * (x / y);
  vec2 at = sine_cosine(angle);
  return vec2(radius * at.y, radius * at.x);
}

SHADER_END
#endif
