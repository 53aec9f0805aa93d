// Random places and directions, from two numbers in [0, 1).
#ifndef SAMPLING_GLSL
#define SAMPLING_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

// Evenly on the disk of radius 1, by squares within squares: Shirley and Chiu, "A Low Distortion Map Between Disk and Square" (1997).
vec2 on_disk(vec2 u) {
  float x = 2.0f * u.x - 1.0f;
  float y = 2.0f * u.y - 1.0f;
  bool wide = abs(x) > abs(y);
  float radius = wide ? x : y;
  float angle = radius == 0.0f ? 0.0f : wide ? 0.25f * PI * (y / x) : 0.5f * PI - 0.25f * PI * (x / y);
  vec2 at = sine_cosine(angle);
  return vec2(radius * at.y, radius * at.x);
}

// By cosine about z: Malley's, up from the disk. Its radius is known without rounding; 1 − x² − y² at the rim is not.
vec3 cosine_direction(vec2 u) {
  vec2 at = on_disk(u);
  float radius = maximum(abs(2.0f * u.x - 1.0f), abs(2.0f * u.y - 1.0f));
  return vec3(at.x, at.y, sqrt((1.0f - radius) * (1.0f + radius)));
}

// Two directions that are square to the unit vector n and to each other. The first turns about an axis that no wall stands along.
void tangents(vec3 n, OUT(vec3) s, OUT(vec3) t) {
  s = normalize3(cross3(vec3(0.31753204f, 0.90757246f, 0.27474649f), n));
  t = cross3(n, s);
}

SHADER_END
#endif
