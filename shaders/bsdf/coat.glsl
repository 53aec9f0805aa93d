// A clear coat of lacquer over everything else, of index 1.5.
#ifndef COAT_GLSL
#define COAT_GLSL
#include "bsdf/bsdf_record.glsl"
#include "bsdf/ggx.glsl"
#include "bsdf/layers.glsl"

SHADER_BEGIN

vec3 coat_albedo(Bsdf bsdf) { return mirrored_once(coat_fresnel(), bsdf.coat_albedo) * bsdf.coat; }

LobeValue coat_value(Bsdf bsdf, Directions at) {
  LobeValue result = no_value();
  if (at.i.z > 0.0f) {
    vec2 reflection = ggx_reflection(at.o, at.i, at.half_way, ggx_width(bsdf.coat_roughness));
    result.value = mirrored_share(coat_fresnel(), dot3(at.o, at.half_way)) * (reflection.x * bsdf.coat);
    result.density = reflection.y;
  }
  return result;
}

vec3 coat_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return ggx_direction(o, ggx_width(bsdf.coat_roughness), u); }

SHADER_END
#endif
