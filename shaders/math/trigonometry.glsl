// Sine and cosine that are the same everywhere.
#ifndef TRIGONOMETRY_GLSL
#define TRIGONOMETRY_GLSL
#include "math/math.glsl"

SHADER_BEGIN

// sin x, cos x within 1.2e-7 for |x| ≤ 30 000: Cody and Waite's reduction to [−π/4, π/4], polynomials of degree 7 and 8 (Cephes).
vec2 sine_cosine(float x) {
  float k = floor(x * 0.636619772f + 0.5f);
  float r = ((x - k * 1.5703125f) - k * 4.83751297e-4f) - k * 7.54978995e-8f;
  float z = r * r;
  float s = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * r + r;
  float c = ((2.443315711e-5f * z - 1.388731625e-3f) * z + 4.166664568e-2f) * z * z - 0.5f * z + 1.0f;
  float quarter = k - 4.0f * floor(0.25f * k);
  bool odd = quarter == 1.0f || quarter == 3.0f;
  vec2 turned = odd ? vec2(c, s) : vec2(s, c);
  return vec2(quarter >= 2.0f ? -turned.x : turned.x, quarter == 1.0f || quarter == 2.0f ? -turned.y : turned.y);
}

SHADER_END
#endif
