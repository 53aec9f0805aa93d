// Ambient, diffuse and a highlight, with an optional mirror on top.
#ifndef PHONG_GLSL
#define PHONG_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering phong_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  s.ambient = texture_color(material.ambient, context.place) * context.color;
  s.diffuse = texture_color(material.base, context.place) * context.color;
  s.specular = texture_color(material.specular, context.place);
  s.reflected = texture_color(material.reflected, context.place);
#if HAS_EMISSION
  s.emitted = texture_color(material.emission, context.place) * context.color;
#endif
  return s;
}

#if RANDOM_WALK
Bsdf phong_bsdf(Material material, ScatteringContext context, Scattering scattering) { return bsdf_of_scattering(scattering); }
#endif

SHADER_END
#endif
