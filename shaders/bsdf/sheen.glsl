// Fibres that stand out of cloth, and light up where it is seen along: Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF"
// (SIGGRAPH 2017), with the shorter masking of KHR_materials_sheen. Edge-on it would scatter more light than arrives: the table weakens
// it, for both directions alike. Directions are uniform, as the paper advises: chosen by cosine, they would hardly ever be grazing.
#ifndef SHEEN_GLSL
#define SHEEN_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

#define LEAST_SHEEN_ROUGHNESS 0.07f

vec3 sheen_albedo(Bsdf bsdf) { return bsdf.sheen * bsdf.sheen_albedo.y; }

LobeValue sheen_value(Bsdf bsdf, Directions at) {
  LobeValue result = no_value();
  if (at.i.z > 0.0f) {
    float r = maximum(bsdf.sheen_roughness, LEAST_SHEEN_ROUGHNESS);
    float narrow = 1.0f / (r * r);
    float fibres = (2.0f + narrow) * power_of_complement(at.half_way.z * at.half_way.z, 0.5f * narrow) / (2.0f * PI);
    float seen = 4.0f * (at.i.z + at.o.z - at.i.z * at.o.z);
    float most = maximum(maximum(bsdf.sheen_albedo.x, sheen_table(at.i.z, bsdf.sheen_roughness).x), 1.0f);
    result.value = bsdf.sheen * (fibres / (seen * most) * at.i.z);
    result.density = 0.5f / PI;
  }
  return result;
}

vec3 sheen_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return half_sphere_direction(u); }

SHADER_END
#endif
