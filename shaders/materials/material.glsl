// From a material and a point to its scattering, in Whitted's terms and as a BSDF: calls the material's kind.
#ifndef MATERIAL_GLSL
#define MATERIAL_GLSL
#include "materials/scattering.glsl"

SHADER_BEGIN

// material: load_material(index).
Scattering scattering_of(uint index, Material material, ScatteringContext context) {
  Scattering s = no_scattering();
#ifdef SCENE_MATERIALS
  // Each material as constants: hardly anything of it is left to compute.
#define SCATTERING_OF_ONE(name, i, constants) \
  if (index == i) s = name##_scattering(constants, context);
  SCENE_MATERIALS(SCATTERING_OF_ONE)
#else
#define SCATTERING_OF(name, number) \
  if (material.kind == number) s = name##_scattering(material, context);
  MATERIALS(SCATTERING_OF)
#endif
  return s;
}

#if RANDOM_WALK
Bsdf bsdf_of(uint index, Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
#ifdef SCENE_MATERIALS
#define BSDF_OF_ONE(name, i, constants) \
  if (index == i) bsdf = name##_bsdf(constants, context, scattering);
  SCENE_MATERIALS(BSDF_OF_ONE)
#else
#define BSDF_OF(name, number) \
  if (material.kind == number) bsdf = name##_bsdf(material, context, scattering);
  MATERIALS(BSDF_OF)
#endif
  return bsdf;
}

#if HAS_PANES
// The share of light that a surface lets straight through: nothing where it is neither a pane nor an interface.
vec3 passed_by(Material material, ScatteringContext context) {
  vec3 passed = vec3(0.0f, 0.0f, 0.0f);
#define PASSED_BY(name, number) \
  if (material.kind == number) passed = name##_passed(material, context);
  if ((material.flags & MATERIAL_PANE) != 0u || is_interface(material, context)) {
    PANES(PASSED_BY)
  }
  return passed;
}
#endif
#endif

SHADER_END
#endif
