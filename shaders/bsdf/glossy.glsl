// A rough mirror, a layer or metal or both: the light that one microfacet reflects.
#ifndef GLOSSY_GLSL
#define GLOSSY_GLSL
#include "bsdf/facets.glsl"

SHADER_BEGIN

vec3 glossy_albedo(Bsdf bsdf) {
  vec3 metal = bsdf.metal.conductor ? bsdf.metal.mean * (1.0f - bsdf.albedo.x) : mirrored_once(bsdf.metal, bsdf.albedo);
  return mirrored_once(bsdf.layer, bsdf.albedo) * bsdf.layered + metal * bsdf.metallic;
}

LobeValue glossy_value(Bsdf bsdf, Directions at) {
  LobeValue result = no_value();
  if (at.i.z > 0.0f) {
    vec2 reflection = ggx_reflection(at.o, at.i, at.half_way, facets_of(bsdf));
    float cosine = dot3(at.o, at.half_way);
    vec3 share = layer_share(bsdf, cosine) * bsdf.layered + metal_share(bsdf, cosine) * bsdf.metallic;
    result.value = share * reflection.x;
    result.density = reflection.y;
  }
  return result;
}

vec3 glossy_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return ggx_direction(o, facets_of(bsdf), u); }

SHADER_END
#endif
