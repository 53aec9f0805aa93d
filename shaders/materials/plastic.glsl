// A coloured body under a clear, rough or polished surface: principled, of which no part is metal.
#ifndef PLASTIC_GLSL
#define PLASTIC_GLSL
#include "materials/principled.glsl"

SHADER_BEGIN

Scattering plastic_scattering(Material material, ScatteringContext context) { return phong_scattering(material, context); }

#if RANDOM_WALK
Bsdf plastic_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  return principled_bsdf(material, context, scattering);
}
#endif

SHADER_END
#endif
