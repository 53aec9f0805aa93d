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
  vec3 o = at.o;
  vec3 i = at.i;
  vec3 half_way = at.half_way;
#if HAS_BENT_COAT
  if (bsdf.coat_normal.z != 1.0f) {
    o = seen_from(into_coat(bsdf, o));
    i = into_coat(bsdf, i);
    half_way = half_way_of(o, i);
  }
#endif
  if (i.z > 0.0f) {
    vec2 reflection = ggx_reflection(o, i, half_way, ggx_width(bsdf.coat_roughness));
    result.value = mirrored_share(coat_fresnel(), dot3(o, half_way)) * (reflection.x * bsdf.coat);
    result.density = reflection.y;
#if HAS_BENT_COAT
    // Photons are weighed by the surface's normal (integrators/photon.glsl); here by the coat's instead.
    if (bsdf.adjoint) result.value = result.value * (o.z / at.o.z * (abs(at.i.z) / i.z));
#endif
  }
  return result;
}

vec3 coat_direction(Bsdf bsdf, vec3 o, vec2 u, float part) {
#if HAS_BENT_COAT
  if (bsdf.coat_normal.z != 1.0f)
    return out_of_frame(frame_turned_to(bsdf.coat_normal), ggx_direction(seen_from(into_coat(bsdf, o)), ggx_width(bsdf.coat_roughness), u));
#endif
  return ggx_direction(o, ggx_width(bsdf.coat_roughness), u);
}

SHADER_END
#endif
