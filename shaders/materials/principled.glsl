// glTF 2.0's metallic-roughness, with KHR_materials_ior, _specular, _clearcoat, _sheen, _transmission, _volume, _diffuse_transmission,
// _anisotropy, _iridescence and _dispersion.
#ifndef PRINCIPLED_GLSL
#define PRINCIPLED_GLSL
#if RANDOM_WALK
#include "bsdf/facets.glsl"
#include "bsdf/layers.glsl"
#endif
#include "materials/dielectric.glsl"
#include "materials/phong.glsl"

SHADER_BEGIN

vec3 principled_f0(Material material) { return vec3(material.b); }  // F0 of all but metal, where its texture is white; and …
float principled_f90(Material material) { return material.b.w; }  // … so seen edge-on

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
vec3 principled_color(Material material, ScatteringContext context) {
  vec3 color = color_of(material, context.point);
  if (HAS_TRANSMISSION == 1 && (material.flags & MATERIAL_CLEAR) != 0u) color = base_of(material, context.point);
  return color * context.color;
}

// Splits the body, which is that share of the surface, into the light that it scatters back and the light that it lets through evenly.
// Where the index falls, part of the latter is reflected totally: in balance, both sides send as much light through.
void add_body(INOUT(Bsdf) bsdf, Material material, ScatteringContext context, vec3 color, float body) {
  bsdf.diffuse = color * body;
#if HAS_TRANSLUCENT
  float through = diffuse_transmission_of(material, context.point).x;
  if (through > 0.0f) {
    vec3 tint = diffuse_transmission_color_of(material, context.point);
    float ratio = context.ior_to / context.ior_from;
    float crossing = through * minimum(ratio * ratio, 1.0f);
    bsdf.translucent = tint * (body * crossing);
    bsdf.diffuse = (color * (1.0f - through) + tint * (through - crossing)) * body;
  }
#endif
}

// The body, the mirror above it, coat and sheen; no light goes through yet.
Bsdf principled_surface(Material material, ScatteringContext context, vec3 color, float metallic) {
  Bsdf bsdf = black_bsdf();
  add_body(bsdf, material, context, color, 1.0f - metallic);
#if HAS_GLOSSY
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  vec3 f0 = principled_f0(material);
  float f90 = principled_f90(material);
  vec3 edge = white * f90;
#if HAS_SPECULAR_TEXTURES
  vec3 tint = specular_color_of(material, context.point);
  float level = specular_level_of(material, context.point).x;
  f0 = vec3(minimum(f0.x * tint.x, f90), minimum(f0.y * tint.y, f90), minimum(f0.z * tint.z, f90)) * level;
  edge = edge * level;
#endif
  bsdf.layer = schlick(f0, edge);
  bsdf.layered = 1.0f - metallic;
  bsdf.metal = schlick(color, white);
  bsdf.metallic = metallic;
  bsdf.roughness = roughness_of(material, context.point).y;
#if HAS_ANISOTROPY
  if ((material.flags & MATERIAL_ANISOTROPIC) != 0u) {
    float strength = anisotropy_of(material, context.point).z;
    float width = ggx_width(bsdf.roughness);
    float along = width + (1.0f - width) * (strength * strength);
    if (along > width) {
      bsdf.widths = vec2(along, width);
      bsdf.roughness = sqrt(evened_width(bsdf.widths));
    }
  }
#endif
  bsdf.albedo = ggx_albedo(viewed_cosine(context), bsdf.roughness);
#if HAS_FILM
  Film film = no_film();
  film.share = iridescence_of(material, context.point).x;
  film.ior = material.iridescence_ior;
  film.thickness = material.iridescence_least +
                   (material.iridescence_most - material.iridescence_least) * iridescence_thickness_of(material, context.point).y;
  if (film.share > 0.0f && film.thickness > 0.0f) bsdf = under_film(bsdf, film, viewed_cosine(context));
#endif
#endif
#if HAS_COAT
  bsdf.coat = coat_of(material, context.point).x;
  bsdf.coat_roughness = coat_roughness_of(material, context.point).y;
  bsdf.coat_albedo = ggx_albedo(coat_cosine(context), bsdf.coat_roughness);
#if HAS_BENT_COAT
  bsdf.coat_normal = context.coat_normal;
#endif
#endif
#if HAS_SHEEN
  bsdf.sheen = sheen_of(material, context.point);
  bsdf.sheen_roughness = sheen_roughness_of(material, context.point).y;
  bsdf.sheen_albedo = sheen_table(viewed_cosine(context), bsdf.sheen_roughness);
#endif
  return bsdf;
}

float principled_through(Material material, ScatteringContext context, float metallic) {
  return transmission_of(material, context.point).x * (1.0f - metallic);
}

#if HAS_PANES
// The light that a pane with that surface lets through straight.
vec3 passed_straight(Bsdf bsdf, vec3 color, float through) {
  vec3 passed = color * through * (vec3(1.0f, 1.0f, 1.0f) - layer_albedo(bsdf.layer, bsdf.albedo)) * under_layers(layers_towards_viewer(bsdf), 2u);
  if (HAS_THIN == 1 && bsdf.roughness > 0.0f) passed = vec3(0.0f, 0.0f, 0.0f);
  return passed;
}

// The light that an interface with that surface lets through. Its glass lies under coat and sheen alone.
vec3 crossed_straight(Bsdf bsdf, vec3 color, float through) { return color * through * under_layers(layers_towards_viewer(bsdf), 2u); }

vec3 principled_passed(Material material, ScatteringContext context) {
  float metallic = metallic_of(material, context.point).z;
  vec3 color = principled_color(material, context);
  Bsdf surface = principled_surface(material, context, color, metallic);
  float through = principled_through(material, context, metallic);
  return is_interface(material, context) ? crossed_straight(surface, color, through) : passed_straight(surface, color, through);
}
#endif

Bsdf principled_bsdf(Material material, ScatteringContext context, Scattering scattering) {
  float metallic = metallic_of(material, context.point).z;
  vec3 color = principled_color(material, context);
  Bsdf bsdf = principled_surface(material, context, color, metallic);
#if HAS_TRANSMISSION
  vec3 white = vec3(1.0f, 1.0f, 1.0f);
  float through = principled_through(material, context, metallic);
  bool pane = (material.flags & MATERIAL_PANE) != 0u;
  if (through > 0.0f) {
    add_body(bsdf, material, context, color, 1.0f - metallic - through);
#if HAS_PANES
    if (pane) bsdf.passed = passed_straight(bsdf, color, through);
#if HAS_THIN
    if (pane && bsdf.roughness > 0.0f) bsdf.thin = color * through;
#endif
#endif
    if (HAS_MEDIA == 1 && !pane) {
      float mirrored = context.ior_from == context.ior_to ? 0.0f : fresnel_reflectance(context.cos_view, context.ior_from, context.ior_to);
      Scattering surface = no_scattering();
      surface.reflected = white * mirrored;
      surface.transmitted = white * (1.0f - mirrored);
      bool crosses = false;
#if HAS_PANES
      crosses = is_interface(material, context);
      if (crosses) bsdf.passed = crossed_straight(bsdf, color, through);
#endif
      if (!crosses) add_glass(bsdf, surface, bsdf.roughness, through, color, context);
#if HAS_GLOSSY
      bsdf.layered = bsdf.layered - through;
#endif
    }
  }
#endif
  return bsdf;
}
#endif

SHADER_END
#endif
