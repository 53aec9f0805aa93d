// The directional albedo of GGX: how much light a rough mirror sends on that no other microfacet takes. From a table
// (host/optics/ggx_albedo.hpp), which is smooth in √cosine and roughness.
#ifndef GGX_ALBEDO_GLSL
#define GGX_ALBEDO_GLSL
#include "bsdf/fresnel.glsl"
#include "records.h"

SHADER_BEGIN

#define GGX_ALBEDOS 64  // rows by roughness, and places in each by √cosine

// .x of a perfect mirror, .y the same weighted by Schlick's (1 − cosine)⁵ at the microfacets; .z and .w: means of both over the half
// sphere, by cosine.
vec4 ggx_albedo(float cosine, float roughness) {
  float x = sqrt(minimum(maximum(cosine, 0.0f), 1.0f)) * float(GGX_ALBEDOS - 1);
  float y = minimum(maximum(roughness, 0.0f), 1.0f) * float(GGX_ALBEDOS - 1);
  float left = minimum(floor(x), float(GGX_ALBEDOS - 2));
  float low = minimum(floor(y), float(GGX_ALBEDOS - 2));
  uint at = uint(low) * uint(GGX_ALBEDOS) + uint(left);
  vec4 below = load_ggx_albedo(at) * (1.0f - (x - left)) + load_ggx_albedo(at + 1u) * (x - left);
  vec4 above = load_ggx_albedo(at + uint(GGX_ALBEDOS)) * (1.0f - (x - left)) + load_ggx_albedo(at + uint(GGX_ALBEDOS) + 1u) * (x - left);
  return below * (1.0f - (y - low)) + above * (y - low);
}

// What a glossy layer mirrors in all, with what its microfacets throw at each other (Kulla and Conty, "Revisiting Physically Based
// Shading at Imageworks", SIGGRAPH 2017): `once` after one of them, `often` after more.
vec3 mirrored_often(Fresnel fresnel, vec4 albedo) {
  vec3 mean = fresnel.mean * fresnel.mean * albedo.z;
  vec3 rest = vec3(1.0f, 1.0f, 1.0f) - fresnel.mean * (1.0f - albedo.z);
  return mean / rest;
}
vec3 mirrored_once(Fresnel fresnel, vec4 albedo) { return fresnel.f0 * (albedo.x - albedo.y) + fresnel.f90 * albedo.y; }
vec3 layer_albedo(Fresnel fresnel, vec4 albedo) {
  return mirrored_once(fresnel, albedo) + mirrored_often(fresnel, albedo) * (1.0f - albedo.x);
}
vec3 mean_layer_albedo(Fresnel fresnel, vec4 albedo) {
  return fresnel.f0 * (albedo.z - albedo.w) + fresnel.f90 * albedo.w + mirrored_often(fresnel, albedo) * (1.0f - albedo.z);
}

SHADER_END
#endif
