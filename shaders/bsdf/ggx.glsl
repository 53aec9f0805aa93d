// GGX microfacets with height-correlated masking. Walter et al., "Microfacet Models for Refraction through Rough Surfaces" (EGSR 2007);
// Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (JCGT 2014). Directions are unit, in the surface's
// frame, whose z is the normal.
#ifndef GGX_GLSL
#define GGX_GLSL
#include "math/trigonometry.glsl"

SHADER_BEGIN

#define LEAST_ROUGHNESS 0.0316227766f  // whose square, the slope, is 0.001: smoother surfaces count as that

// The width of the distribution of slopes.
float ggx_width(float roughness) {
  float r = minimum(maximum(roughness, LEAST_ROUGHNESS), 1.0f);
  return r * r;
}

// The density of microfacets with normal h, by a sum without 1 − cos², which is exact for narrow lobes.
float ggx_density(vec3 h, float width) {
  float sum = (h.x * h.x + h.y * h.y) / (width * width) + h.z * h.z;
  return 1.0f / (PI * (width * width) * (sum * sum));
}

// Smith's Λ.
float ggx_lambda(vec3 w, float width) {
  float slope = (w.x * w.x + w.y * w.y) / maximum(w.z * w.z, 1.0e-20f);
  return 0.5f * (sqrt(1.0f + width * width * slope) - 1.0f);
}

// A microfacet's normal, of those that o sees: Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps" (HPG 2023).
vec3 ggx_normal(vec3 o, float width, vec2 u) {
  vec3 v = normalize3(vec3(width * o.x, width * o.y, o.z));
  float x = u.y * (1.0f + v.z);
  float radius = sqrt(x * maximum(2.0f - x, 0.0f));
  vec2 turn = sine_cosine(2.0f * PI * u.x);
  vec3 cap = vec3(radius * turn.y, radius * turn.x, 1.0f - x);
  return normalize3(vec3(width * (cap.x + v.x), width * (cap.y + v.y), maximum(cap.z + v.z, 1.0e-7f)));
}

// The direction to which a microfacet mirrors o; 0 if it is below the surface.
vec3 ggx_direction(vec3 o, float width, vec2 u) {
  vec3 i = mirror3(o, ggx_normal(o, width, u));
  return i.z > 0.0f ? i : vec3(0.0f, 0.0f, 0.0f);
}

// Reflection from i to o, with perfect mirrors as microfacets. x: value · cosine. y: the density of i as a sample.
vec2 ggx_reflection(vec3 o, vec3 i, vec3 h, float width) {
  float towards_o = 1.0f + ggx_lambda(o, width);
  float d = ggx_density(h, width) / (4.0f * o.z);
  return vec2(d / (towards_o + ggx_lambda(i, width)), d / towards_o);
}

SHADER_END
#endif
