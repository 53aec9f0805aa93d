// Interpolation in a table of albedos (records.h), which are smooth in √cosine and roughness.
#ifndef ALBEDO_TABLE_GLSL
#define ALBEDO_TABLE_GLSL
#include "math/math.glsl"
#include "records.h"

SHADER_BEGIN

// `side`: rows, and columns in each.
vec4 albedo_between(uint first, uint side, float cosine, float roughness) {
  float x = sqrt(minimum(maximum(cosine, 0.0f), 1.0f)) * float(side - 1u);
  float y = minimum(maximum(roughness, 0.0f), 1.0f) * float(side - 1u);
  float left = minimum(floor(x), float(side - 2u));
  float low = minimum(floor(y), float(side - 2u));
  uint at = first + uint(low) * side + uint(left);
  vec4 below = load_albedo(at) * (1.0f - (x - left)) + load_albedo(at + 1u) * (x - left);
  vec4 above = load_albedo(at + side) * (1.0f - (x - left)) + load_albedo(at + side + 1u) * (x - left);
  return below * (1.0f - (y - low)) + above * (y - low);
}

SHADER_END
#endif
