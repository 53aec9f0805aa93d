// The directional albedo of GGX: how much light a rough mirror sends on that no other microfacet takes. From a table
// (host/optics/ggx_albedo.hpp), which is smooth in √cosine and roughness.
#ifndef GGX_ALBEDO_GLSL
#define GGX_ALBEDO_GLSL
#include "bsdf/albedo_table.glsl"
#include "bsdf/fresnel.glsl"

SHADER_BEGIN

// .x what a perfect mirror loses by other microfacets, since float32 cannot tell the albedo of a smooth one from 1; .y its albedo weighted
// by Schlick's (1 − cosine)⁵ at the microfacets; .z and .w: means of both over the half sphere, by cosine.
vec4 ggx_albedo(float cosine, float roughness) { return albedo_between(0u, GGX_ALBEDOS, cosine, roughness); }

// What a glossy layer mirrors in all, with what its microfacets throw at each other (Kulla and Conty, "Revisiting Physically Based
// Shading at Imageworks", SIGGRAPH 2017): `once` after one of them, `often` after more.
vec3 mirrored_often(Fresnel fresnel, vec4 albedo) {
  vec3 mean = fresnel.mean * fresnel.mean * (1.0f - albedo.z);
  vec3 rest = vec3(1.0f, 1.0f, 1.0f) - fresnel.mean * albedo.z;
  return mean / rest;
}
vec3 mirrored_once(Fresnel fresnel, vec4 albedo) { return fresnel.f0 * (1.0f - albedo.x - albedo.y) + fresnel.f90 * albedo.y; }
vec3 layer_albedo(Fresnel fresnel, vec4 albedo) {
  return mirrored_once(fresnel, albedo) + mirrored_often(fresnel, albedo) * albedo.x;
}
vec3 mean_layer_albedo(Fresnel fresnel, vec4 albedo) {
  return fresnel.f0 * (1.0f - albedo.z - albedo.w) + fresnel.f90 * albedo.w + mirrored_often(fresnel, albedo) * albedo.z;
}

SHADER_END
#endif
