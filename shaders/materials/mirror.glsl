// A perfect mirror, with a highlight where a light would be seen in it.
#ifndef MIRROR_GLSL
#define MIRROR_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering mirror_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  s.specular = texture_color(material.specular, context.uv);
  s.reflected = texture_color(material.reflected, context.uv);
  return s;
}

SHADER_END
#endif
