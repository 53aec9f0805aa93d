// The microfacets of a BSDF's body, which may be wider along x than along y: GGX as bsdf/ggx.glsl has it, with two widths. Heitz, "Sampling
// the GGX Distribution of Visible Normals" (JCGT 2018). Equal widths take the functions of one width, to the last bit.
#ifndef FACETS_GLSL
#define FACETS_GLSL
#include "bsdf/bsdf_record.glsl"
#include "bsdf/ggx.glsl"

SHADER_BEGIN

#if HAS_ANISOTROPY
#define FACETS vec2

vec2 facets_of(Bsdf bsdf) {
  float width = ggx_width(bsdf.roughness);
  return bsdf.widths.x > 0.0f ? bsdf.widths : vec2(width, width);
}

// The width of even microfacets that lose about as much light to each other: a fit.
float evened_width(vec2 widths) {
  float root = sqrt(0.5f * (widths.x * widths.x + widths.y * widths.y));
  return 0.75f * root + 0.125f * (widths.x + widths.y);
}

bool are_even(vec2 widths) { return widths.x == widths.y; }

float ggx_density(vec3 h, vec2 widths) {
  if (are_even(widths)) return ggx_density(h, widths.x);
  vec2 slope = vec2(h.x / widths.x, h.y / widths.y);
  float sum = slope.x * slope.x + slope.y * slope.y + h.z * h.z;
  return 1.0f / (PI * (widths.x * widths.y) * (sum * sum));
}

float ggx_lambda(vec3 w, vec2 widths) {
  if (are_even(widths)) return ggx_lambda(w, widths.x);
  vec2 across = vec2(widths.x * w.x, widths.y * w.y);
  return 0.5f * (sqrt(1.0f + (across.x * across.x + across.y * across.y) / maximum(w.z * w.z, 1.0e-20f)) - 1.0f);
}

vec3 ggx_normal(vec3 o, vec2 widths, vec2 u) {
  if (are_even(widths)) return ggx_normal(o, widths.x, u);
  // The normal of even facets of width 1, stretched.
  vec3 n = ggx_normal(normalize3(vec3(widths.x * o.x, widths.y * o.y, o.z)), 1.0f, u);
  return normalize3(vec3(widths.x * n.x, widths.y * n.y, n.z));
}

vec3 ggx_direction(vec3 o, vec2 widths, vec2 u) {
  vec3 i = mirror3(o, ggx_normal(o, widths, u));
  return i.z > 0.0f ? i : vec3(0.0f, 0.0f, 0.0f);
}

vec2 ggx_reflection(vec3 o, vec3 i, vec3 h, vec2 widths) {
  float towards_o = 1.0f + ggx_lambda(o, widths);
  float d = ggx_density(h, widths) / (4.0f * o.z);
  return vec2(d / (towards_o + ggx_lambda(i, widths)), d / towards_o);
}

// As ggx_albedo, for facets that may be uneven: by 64 facets that w sees, a lattice by the golden ratio. The means are those of even ones.
vec4 facets_albedo(vec3 w, vec2 widths, float roughness) {
  vec4 albedo = ggx_albedo(w.z, roughness);
  if (are_even(widths)) return albedo;
  float once = 0.0f;
  float edge = 0.0f;
  float towards_w = 1.0f + ggx_lambda(w, widths);
  for (uint n = 0u; n < 64u; n++) {
    float step = float(n) + 0.5f;
    float turn = step * 0.618034f;
    vec3 h = ggx_normal(w, widths, vec2(turn - floor(turn), step * 0.015625f));
    float along = minimum(dot3(w, h), 1.0f);
    vec3 i = mirror3(w, h);
    float share = i.z > 0.0f ? towards_w / (towards_w + ggx_lambda(i, widths)) : 0.0f;
    once = once + share;
    edge = edge + share * fifth_power(1.0f - along);
  }
  return vec4(1.0f - once * 0.015625f, edge * 0.015625f, albedo.z, albedo.w);
}
#else
#define FACETS float
float facets_of(Bsdf bsdf) { return ggx_width(bsdf.roughness); }
#endif

SHADER_END
#endif
