// glTF 2.0's metallic-roughness, with KHR_materials_ior, _specular, _clearcoat, _sheen, _transmission and _volume. material.b: F0 of what is
// no metal, and F90, where their textures are white.
#ifndef PRINCIPLED_GLSL
#define PRINCIPLED_GLSL
#if RANDOM_WALK
#include "bsdf/layers.glsl"
#endif
#include "materials/dielectric.glsl"
#include "materials/phong.glsl"

SHADER_BEGIN

Scattering principled_scattering(Material material, ScatteringContext context) {
  Scattering s = phong_scattering(material, context);
#if HAS_TRANSMISSION
  if ((material.flags & MATERIAL_CLEAR) != 0u) {
    vec3 emitted = s.emitted;
    s = dielectric_scattering(material, context);
    s.emitted = emitted;
  }
#endif
  return s;
}

#if RANDOM_WALK
Bsdf principled_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  Bsdf bsdf = black_bsdf();
  uint colored = material.color;
#if HAS_TRANSMISSION
  colored = (material.flags & MATERIAL_CLEAR) != 0u ? material.base : material.color;
#endif
  vec3 color = texture_color(colored, context.place) * context.color;
  float metallic = texture_color(material.metallic, context.place).z;
  bsdf.diffuse = color * (1.0f - metallic);
#if HAS_GLOSSY
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  vec3 f0 = vec3(material.b);
  vec3 edge = white * material.b.w;
#if HAS_SPECULAR_TEXTURES
  vec3 tint = texture_color(material.specular_color, context.place);
  float level = texture_color(material.specular_level, context.place).x;
  f0 = vec3(minimum(f0.x * tint.x, material.b.w), minimum(f0.y * tint.y, material.b.w), minimum(f0.z * tint.z, material.b.w)) * level;
  edge = edge * level;
#endif
  bsdf.layer = schlick(f0, edge);
  bsdf.glossy = schlick(f0 * (1.0f - metallic) + color * metallic, edge * (1.0f - metallic) + white * metallic);
  bsdf.roughness = texture_color(material.roughness, context.place).y;
  bsdf.albedo = ggx_albedo(viewed_cosine(context), bsdf.roughness);
#endif
#if HAS_TRANSMISSION
  float through = texture_color(material.transmission, context.place).x * (1.0f - metallic);
  bool pane = (material.flags & MATERIAL_PANE) != 0u;
  if (through > 0.0f) {
    bsdf.diffuse = color * (1.0f - metallic - through);
#if HAS_PANES
    if (pane) bsdf.passed = color * through * (white - layer_albedo(bsdf.layer, bsdf.albedo));
#if HAS_THIN
    if (pane && bsdf.roughness > 0.0f) {
      bsdf.passed = vec3(0.0f, 0.0f, 0.0f);
      bsdf.thin = color * through;
    }
#endif
#endif
#if HAS_MEDIA
    if (!pane) {
      float mirrored = context.ior_from == context.ior_to ? 0.0f : fresnel_reflectance(context.cos_view, context.ior_from, context.ior_to);
      Scattering surface = no_scattering();
      surface.reflected = white * mirrored;
      surface.transmitted = white * (1.0f - mirrored);
      add_glass(bsdf, surface, bsdf.roughness, through, color, context);
      bsdf.covered = 1.0f - through;
    }
#endif
  }
#endif
#if HAS_COAT
  bsdf.coat = texture_color(material.coat, context.place).x;
  bsdf.coat_roughness = texture_color(material.coat_roughness, context.place).y;
  bsdf.coat_albedo = ggx_albedo(viewed_cosine(context), bsdf.coat_roughness);
#endif
#if HAS_SHEEN
  bsdf.sheen = texture_color(material.sheen, context.place);
  bsdf.sheen_roughness = texture_color(material.sheen_roughness, context.place).y;
  bsdf.sheen_albedo = sheen_table(viewed_cosine(context), bsdf.sheen_roughness);
#endif
#if HAS_TRANSMISSION
  // Single directions cross the layers too.
  float under = under_layers(bsdf, 2u);
  bsdf.mirror = bsdf.mirror * (under * under);
  bsdf.transmitted = bsdf.transmitted * under;
#if HAS_PANES
  bsdf.passed = bsdf.passed * under;
#endif
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
