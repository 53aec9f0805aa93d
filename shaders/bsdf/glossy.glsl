// A rough mirror: what one microfacet reflects.
#ifndef GLOSSY_GLSL
#define GLOSSY_GLSL
#include "bsdf/bsdf_record.glsl"
#include "bsdf/ggx.glsl"

SHADER_BEGIN

vec3 glossy_albedo(Bsdf bsdf) {
  vec3 share = mirrored_once(bsdf.glossy, bsdf.albedo);
  return (bsdf.glossy.conductor ? bsdf.glossy.mean * (1.0f - bsdf.albedo.x) : share) * bsdf.covered;
}

LobeValue glossy_value(Bsdf bsdf, Directions at) {
  LobeValue result = no_value();
  if (at.i.z > 0.0f) {
    vec2 reflection = ggx_reflection(at.o, at.i, at.half_way, ggx_width(bsdf.roughness));
    result.value = mirrored_share(bsdf.glossy, dot3(at.o, at.half_way)) * (reflection.x * bsdf.covered);
    result.density = reflection.y;
  }
  return result;
}

vec3 glossy_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return ggx_direction(o, ggx_width(bsdf.roughness), u); }

SHADER_END
#endif
