// How a surface scatters light at a point, as the sum of its lobes; what a material says of it (materials/material.glsl).
#ifndef BSDF_RECORD_GLSL
#define BSDF_RECORD_GLSL
#include "bsdf/ggx_albedo.glsl"

SHADER_BEGIN

struct Bsdf {
  vec3 diffuse;            // albedo, under the layer
  float diffuse_roughness;
  vec3 mirror;             // throughput of the mirrored direction, and …
  vec3 transmitted;        // … of the refracted one
  float roughness;         // of the glossy lobe, and of rough glass
#if HAS_GLOSSY
  Fresnel glossy;
  Fresnel layer;           // that light goes through to the diffuse lobe and back
  vec4 albedo;             // ggx_albedo towards the viewer
#endif
#if HAS_COAT
  float coat;              // its share of the surface
  float coat_roughness;
  vec4 coat_albedo;
#endif
#if HAS_ROUGH_GLASS
  vec3 glass;              // throughput of rough glass, before Fresnel
  float ior_from;
  float ior_to;
#endif
};

// Whether a lobe sends on light from behind the surface.
bool transmits(Bsdf bsdf) {
#if HAS_ROUGH_GLASS
  return max_component(bsdf.glass) > 0.0f;
#else
  return false;
#endif
}

// What all lobes ask of a pair of directions: towards the viewer, towards the light, unit, in the surface's frame.
struct Directions {
  vec3 o;
  vec3 i;
  vec3 half_way;
#if HAS_GLOSSY
  vec4 albedo;    // ggx_albedo towards the light
#endif
};

// A lobe's BSDF · |cosine| of the light, and the density of its direction by solid angle.
struct LobeValue {
  vec3 value;
  float density;
};

LobeValue no_value() {
  LobeValue none;
  none.value = vec3(0.0f, 0.0f, 0.0f);
  none.density = 0.0f;
  return none;
}

Bsdf black_bsdf() {
  vec3 black = vec3(0.0f, 0.0f, 0.0f);
  Bsdf bsdf;
  bsdf.diffuse = black;
  bsdf.diffuse_roughness = 0.0f;
  bsdf.mirror = black;
  bsdf.transmitted = black;
  bsdf.roughness = 1.0f;
#if HAS_GLOSSY
  bsdf.glossy = schlick(black, black);
  bsdf.layer = bsdf.glossy;
  bsdf.albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#endif
#if HAS_COAT
  bsdf.coat = 0.0f;
  bsdf.coat_roughness = 1.0f;
  bsdf.coat_albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#endif
#if HAS_ROUGH_GLASS
  bsdf.glass = black;
  bsdf.ior_from = 1.0f;
  bsdf.ior_to = 1.0f;
#endif
  return bsdf;
}

SHADER_END
#endif
