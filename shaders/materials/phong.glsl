// Ambient, diffuse and a highlight, with an optional mirror on top.
#ifndef PHONG_GLSL
#define PHONG_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering phong_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  s.ambient = ambient_of(material, context.point) * context.color;
  s.diffuse = base_of(material, context.point) * context.color;
  s.specular = specular_of(material, context.point);
  s.reflected = reflected_of(material, context.point);
#if HAS_EMISSION
  s.emitted = emission_of(material, context.point) * context.color;
#endif
  return s;
}

#if RANDOM_WALK
Bsdf phong_bsdf(Material material, ScatteringContext context, Scattering scattering) { return bsdf_of_scattering(scattering); }
#endif

SHADER_END
#endif
