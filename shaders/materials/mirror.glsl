// A perfect mirror, with a highlight where a light would be seen in it.
#ifndef MIRROR_GLSL
#define MIRROR_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering mirror_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  s.specular = specular_of(material, context.point);
  s.reflected = reflected_of(material, context.point);
  return s;
}

#if RANDOM_WALK
Bsdf mirror_bsdf(Material material, ScatteringContext context, Scattering scattering) { return bsdf_of_scattering(scattering); }
#endif

SHADER_END
#endif
