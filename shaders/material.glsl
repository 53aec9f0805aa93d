// From a material and a point to its scattering: asks the kind of material.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "scattering.glsl"

SHADER_BEGIN

Scattering scattering_of(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
#define SCATTERING_OF(name, number) \
  if (material.head.x == number) s = name##_scattering(material, context);
  MATERIALS(SCATTERING_OF)
  return s;
}

SHADER_END
#endif
