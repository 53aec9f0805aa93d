// Ambient, diffuse and a highlight, with an optional mirror on top.
#ifndef PHONG_GLSL
#define PHONG_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

Scattering phong_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  s.ambient = texture_color(material.textures.w, context.uv) * context.color;
  s.diffuse = texture_color(material.textures.x, context.uv) * context.color;
  s.specular = texture_color(material.textures.y, context.uv);
  s.reflected = texture_color(material.textures.z, context.uv);
#if HAS_EMISSION
  s.emitted = texture_color(material.head.y >> MATERIAL_EMISSION_SHIFT, context.uv) * context.color;
#endif
  return s;
}

SHADER_END
#endif
