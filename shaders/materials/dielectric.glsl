// Glass and liquids: a surface between two media, unpolarised Fresnel reflectance; or a pane, which has no inside: light between its two
// faces adds up to R' = 2R / (1 + R).
#ifndef DIELECTRIC_GLSL
#define DIELECTRIC_GLSL
#include "bsdf/fresnel.glsl"
#include "materials/scattering.glsl"

SHADER_BEGIN

float pane_ior(Material material) { return material.a.x; }
float pane_reflectance(Material material) { return material.a.y; }  // R' at normal incidence

Scattering dielectric_scattering(Material material, ScatteringContext context) {
  Scattering s = no_scattering();
  bool one_medium = context.ior_from == context.ior_to;
  float reflected = one_medium ? 0.0f : fresnel_reflectance(context.cos_view, context.ior_from, context.ior_to);
  if (HAS_MEDIA == 1 && (material.flags & MATERIAL_PANE) != 0u) {
    reflected = fresnel_reflectance(context.cos_view, context.ior_from, pane_ior(material));
    reflected = 2.0f * reflected / (1.0f + reflected);
  }
  s.specular = specular_of(material, context.point);
  s.reflected = vec3(reflected, reflected, reflected);
  s.transmitted = vec3(1.0f - reflected, 1.0f - reflected, 1.0f - reflected);
  return s;
}

#if RANDOM_WALK
// Adds glass for the share `weight` of the incident light; `color` tints refracted light. Polished, it has single directions, else lobes.
void add_glass(INOUT(Bsdf) bsdf, Scattering surface, float roughness, float weight, vec3 color, ScatteringContext context) {
  bsdf.mirror = bsdf.mirror + surface.reflected * weight;
  bsdf.transmitted = bsdf.transmitted + surface.transmitted * (color * weight);
#if HAS_ROUGH_GLASS
  if (roughness > 0.0f && context.ior_from != context.ior_to) {
    bsdf.mirror = vec3(0.0f, 0.0f, 0.0f);
    bsdf.transmitted = bsdf.mirror;
    bsdf.glass = vec3(weight, weight, weight);
    bsdf.glass_color = color;
    bsdf.ior_from = context.ior_from;
    bsdf.ior_to = context.ior_to;
    bsdf.glass_albedo = glass_table(viewed_cosine(context), roughness, context.ior_from, context.ior_to);
  }
#endif
}

#if HAS_PANES
vec3 dielectric_passed(Material material, ScatteringContext context) {
  vec3 passed = dielectric_scattering(material, context).transmitted;
  if (HAS_THIN == 1 && !is_interface(material, context) && roughness_of(material, context.point).y > 0.0f) passed = vec3(0.0f, 0.0f, 0.0f);
  return passed;
}
#endif

Bsdf dielectric_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  if (HAS_ROUGH_GLASS == 1 || HAS_THIN == 1) bsdf.roughness = roughness_of(material, context.point).y;
  bool pane = (material.flags & MATERIAL_PANE) != 0u;
#if HAS_PANES
  if (pane) {
    bsdf.mirror = scattering.reflected;
    bsdf.passed = scattering.transmitted;
  }
#if HAS_THIN
  if (pane && bsdf.roughness > 0.0f) {
    bsdf.mirror = vec3(0.0f, 0.0f, 0.0f);
    bsdf.passed = bsdf.mirror;
    bsdf.layer = schlick(white * pane_reflectance(material), white);
    bsdf.albedo = ggx_albedo(viewed_cosine(context), bsdf.roughness);
    bsdf.thin = white;
  }
#endif
  if (is_interface(material, context)) {
    bsdf.passed = scattering.transmitted;
    return bsdf;
  }
#endif
  if (HAS_MEDIA == 1 && !pane) add_glass(bsdf, scattering, bsdf.roughness, 1.0f, white, context);
  return bsdf;
}
#endif

SHADER_END
#endif
