// The phase function of a medium, by Henyey and Greenstein ("Diffuse Radiation in the Galaxy", Astrophysical Journal 93, 1941); g is
// the mean cosine of the scattering angle.
#ifndef PHASE_GLSL
#define PHASE_GLSL
#include "math/sampling.glsl"

SHADER_BEGIN

// The phase function per solid angle, which is its own sampling density, from direction `before` to `after`, both unit. 1 − cos is half
// the square of their difference, which keeps its precision where light is hardly deflected.
float phase_value(float g, vec3 before, vec3 after) {
  vec3 difference = after - before;
  float square = (1.0f - g) * (1.0f - g) + g * dot3(difference, difference);
  return (1.0f - g) * (1.0f + g) / (4.0f * PI * square * sqrt(square));
}

// A direction by that density, about z, where light came along −z. The usual cos = (1 + g² − s²) / 2g, s = (1 − g²) / (1 + g − 2gu),
// without its cancellation.
vec3 phase_direction(float g, vec2 u) {
  float divisor = g > 0.0f ? (1.0f - g) + 2.0f * g * (1.0f - u.x) : (1.0f + g) - 2.0f * g * u.x;
  float ratio = (1.0f - g) / divisor;
  float versine = minimum(2.0f * u.x * (1.0f + g * (1.0f - u.x)) * (ratio * ratio), 2.0f);
  float sine = sqrt(versine * (2.0f - versine));
  vec2 around = sine_cosine(2.0f * PI * u.y);
  return vec3(sine * around.y, sine * around.x, versine - 1.0f);
}

SHADER_END
#endif
