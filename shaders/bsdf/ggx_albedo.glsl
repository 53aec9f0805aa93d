// The directional albedo of GGX: the share of light that a rough mirror reflects and no other microfacet blocks. From a table
// (host/optics/ggx_albedo.hpp), which is smooth in √cosine and roughness.
#ifndef GGX_ALBEDO_GLSL
#define GGX_ALBEDO_GLSL
#include "bsdf/albedo_table.glsl"
#include "bsdf/fresnel.glsl"

SHADER_BEGIN

// `.x`: the loss of a perfect mirror by other microfacets, since float32 cannot distinguish a smooth one's albedo from 1. `.y`: its albedo
// weighted by Schlick's (1 − cosine)⁵ at the microfacets. `.z`, `.w`: means of both over the half sphere, by cosine.
vec4 ggx_albedo(float cosine, float roughness) { return albedo_between(0u, GGX_ALBEDOS, cosine, roughness); }

// The total reflection of a glossy layer, including light reflected between its microfacets (Kulla and Conty, "Revisiting Physically
// Based Shading at Imageworks", SIGGRAPH 2017): `once` after one of them, `often` after more.
vec3 mirrored_often(Fresnel fresnel, vec4 albedo) {
  vec3 mean = fresnel.mean * fresnel.mean * (1.0f - albedo.z);
  vec3 rest = vec3(1.0f, 1.0f, 1.0f) - fresnel.mean * albedo.z;
  return mean / rest;
}
vec3 mirrored_once(Fresnel fresnel, vec4 albedo) { return fresnel.f0 * (1.0f - albedo.x - albedo.y) + fresnel.f90 * albedo.y; }
vec3 layer_albedo(Fresnel fresnel, vec4 albedo) {
  vec3 all = mirrored_once(fresnel, albedo) + mirrored_often(fresnel, albedo) * albedo.x;
#if HAS_FILM
  // A film's colour may exceed 1 in a channel.
  all = vec3(minimum(all.x, 1.0f), minimum(all.y, 1.0f), minimum(all.z, 1.0f));
#endif
  return all;
}
vec3 mean_layer_albedo(Fresnel fresnel, vec4 albedo) {
  return fresnel.f0 * (1.0f - albedo.z - albedo.w) + fresnel.f90 * albedo.w + mirrored_often(fresnel, albedo) * albedo.z;
}

SHADER_END
#endif
