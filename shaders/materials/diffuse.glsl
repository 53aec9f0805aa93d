// A matte surface, of roughness 0 Lambert's.
#ifndef DIFFUSE_MATERIAL_GLSL
#define DIFFUSE_MATERIAL_GLSL
#include "materials/phong.glsl"

SHADER_BEGIN

Scattering diffuse_scattering(Material material, ScatteringContext context) { return phong_scattering(material, context); }

#if RANDOM_WALK
Bsdf diffuse_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
  bsdf.diffuse = scattering.diffuse;
  bsdf.diffuse_roughness = roughness_of(material, context.point).y;
  return bsdf;
}
#endif

SHADER_END
#endif
