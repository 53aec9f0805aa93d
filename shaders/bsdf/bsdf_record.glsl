// The BSDF of a surface at a point as the sum of its lobes, filled in by its material (materials/material.glsl).
#ifndef BSDF_RECORD_GLSL
#define BSDF_RECORD_GLSL
#if HAS_FILM
#include "bsdf/film.glsl"
#endif
#include "bsdf/ggx_albedo.glsl"

SHADER_BEGIN

// The albedo of sheen: .x as its formula has it, .y as it is weakened (bsdf/sheen.glsl).
vec4 sheen_table(float cosine, float roughness) { return albedo_between(FIRST_SHEEN_ALBEDO, SHEEN_ALBEDOS, cosine, roughness); }

// The share of light that microfacets between two media reflect and refract before another microfacet blocks it.
float glass_table(float cosine, float roughness, float ior_from, float ior_to) {
  // host/tables/albedos.hpp states how slices lie.
  float contrast = (ior_to - ior_from) / ((ior_to + ior_from) * 0.6f);
  float root = sqrt(abs(contrast));
  float below = float(GLASS_SLICES_BELOW);
  float z = below + root * (contrast < 0.0f ? -below : float(GLASS_SLICES) - below);
  float slice = minimum(maximum(floor(z), 0.0f), float(GLASS_SLICES - 1u));
  vec4 albedo = albedo_between(FIRST_GLASS_ALBEDO + uint(slice) * (GLASS_ALBEDOS * GLASS_ALBEDOS), GLASS_ALBEDOS, cosine, roughness);
  return albedo.x * (1.0f - (z - slice)) + albedo.y * (z - slice);
}

// True if f(o, i) of some lobe is not f(i, o).
#define HAS_ADJOINT (HAS_COAT || HAS_SHEEN || HAS_ROUGH_GLASS)

struct Bsdf {
  vec3 diffuse;            // albedo, under the layer
  float diffuse_roughness;
  vec3 mirror;             // throughput of the mirrored direction, and …
  vec3 transmitted;        // … of the refracted one, both under coat and sheen
#if HAS_PANES
  vec3 passed;             // throughput of the light that goes straight on, through a pane
#endif
  float roughness;         // roughness of layer and metal, of rough glass and of a rough pane
#if HAS_GLOSSY
  Fresnel layer;           // that light goes through to the diffuse lobe and back
  float layered;           // the share of the surface that mirrors by the layer
  Fresnel metal;
  float metallic;          // the share of the surface that mirrors by the metal
  vec4 albedo;             // ggx_albedo towards the viewer
#endif
#if HAS_COAT
  float coat;              // its share of the surface
  float coat_roughness;
  vec4 coat_albedo;
#if HAS_BENT_COAT
  vec3 coat_normal;        // (0, 0, 1) where it is the surface's
#endif
#endif
#if HAS_ROUGH_GLASS
  vec3 glass;              // throughput of rough glass, before Fresnel
  vec3 glass_color;        // glass color of the refracted light
  float glass_albedo;      // glass_table towards the viewer
  float ior_from;
  float ior_to;
#endif
#if HAS_SHEEN
  vec3 sheen;              // its colour
  float sheen_roughness;
  vec4 sheen_albedo;       // sheen_table towards the viewer
#endif
#if HAS_THIN
  vec3 thin;               // throughput of a rough pane, under the layer
#endif
#if HAS_TRANSLUCENT
  vec3 translucent;        // albedo of the body for light that it lets through evenly, under the layer
#endif
#if HAS_ANISOTROPY
  vec2 widths;             // widths of the microfacets' slopes along x and along y; 0: by roughness
#endif
#if HAS_FILM
  Film film;               // over layer and metal, which are as it makes them towards the viewer
#endif
#if HAS_ADJOINT
  bool adjoint;            // true for a photon, which comes from `o`
#endif
};

// True if a lobe transmits light from behind the surface.
bool transmits(Bsdf bsdf) {
  float all = 0.0f;
#if HAS_ROUGH_GLASS
  all = max_component(bsdf.glass);
#endif
#if HAS_THIN
  all = all + max_component(bsdf.thin);
#endif
#if HAS_TRANSLUCENT
  all = all + max_component(bsdf.translucent);
#endif
  return all > 0.0f;
}

// The values of a pair of directions that all lobes need: towards the viewer, towards the light, unit, in the
// surface's frame.
struct Directions {
  vec3 o;
  vec3 i;
  vec3 half_way;
#if HAS_GLOSSY
  vec4 albedo;  // ggx_albedo towards the light, on either side
#if HAS_FILM
  Fresnel layer;  // the BSDF's, towards the light
#endif
#endif
};

vec3 half_way_of(vec3 o, vec3 i) {
  vec3 sum = o + i;
  return sum / sqrt(maximum(dot3(sum, sum), 1.0e-30f));
}

#if HAS_GLOSSY
// The share of light that a microfacet of the layer mirrors, and one of the metal.
vec3 layer_share(Bsdf bsdf, float cosine) {
#if HAS_FILM
  if (bsdf.film.share > 0.0f) return filmed_share(bsdf.film, film_light(bsdf.film, cosine), bsdf.film.layer_f0, bsdf.film.layer_f90, cosine);
#endif
  return mirrored_share(bsdf.layer, cosine);
}
vec3 metal_share(Bsdf bsdf, float cosine) {
#if HAS_FILM
  if (bsdf.film.share > 0.0f) return filmed_share(bsdf.film, film_light(bsdf.film, cosine), bsdf.film.metal_f0, bsdf.film.metal_f90, cosine);
#endif
  return mirrored_share(bsdf.metal, cosine);
}

// The albedo of a body whose light goes through the layer in and out again.
vec3 under_layer(Bsdf bsdf, Directions at, vec3 albedo) {
  vec3 one = vec3(1.0f, 1.0f, 1.0f);
  Fresnel towards_light = bsdf.layer;
  vec3 mean = mean_layer_albedo(bsdf.layer, bsdf.albedo);
#if HAS_FILM
  if (bsdf.film.share > 0.0f) {
    towards_light = at.layer;
    mean = bsdf.layer.mean * (1.0f - bsdf.albedo.z) + mirrored_often(bsdf.layer, bsdf.albedo) * bsdf.albedo.z;
  }
#endif
  return albedo * (one - layer_albedo(bsdf.layer, bsdf.albedo)) * (one - layer_albedo(towards_light, at.albedo)) / (one - mean);
}

#if HAS_FILM
// Lays the film over the layer and the metal. `cosine`: the viewer's.
Bsdf under_film(Bsdf bsdf, Film film, float cosine) {
  film.layer_f0 = bsdf.layer.f0;
  film.metal_f0 = bsdf.metal.f0;
  film.layer_f90 = bsdf.layer.f90;
  film.metal_f90 = bsdf.metal.f90;
  bsdf.film = film;
  bsdf.layer = filmed(film, film.layer_f0, film.layer_f90, filmed_mean(film, film.layer_f0, film.layer_f90), cosine);
  bsdf.metal = filmed(film, film.metal_f0, film.metal_f90, filmed_mean(film, film.metal_f0, film.metal_f90), cosine);
  return bsdf;
}
#endif
#endif

// A lobe's BSDF · |cosine| of the light, and the density of its direction by solid angle.
struct LobeValue {
  vec3 value;
  float density;
};

LobeValue no_value() {
  LobeValue none;
  none.value = vec3(0.0f, 0.0f, 0.0f);
  none.density = 0.0f;
  return none;
}

Bsdf black_bsdf() {
  vec3 black = vec3(0.0f, 0.0f, 0.0f);
  Bsdf bsdf;
  bsdf.diffuse = black;
  bsdf.diffuse_roughness = 0.0f;
  bsdf.mirror = black;
  bsdf.transmitted = black;
  bsdf.roughness = 1.0f;
#if HAS_PANES
  bsdf.passed = black;
#endif
#if HAS_GLOSSY
  bsdf.layer = schlick(black, black);
  bsdf.layered = 1.0f;
  bsdf.metal = bsdf.layer;
  bsdf.metallic = 0.0f;
  bsdf.albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#endif
#if HAS_COAT
  bsdf.coat = 0.0f;
  bsdf.coat_roughness = 1.0f;
  bsdf.coat_albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#if HAS_BENT_COAT
  bsdf.coat_normal = vec3(0.0f, 0.0f, 1.0f);
#endif
#endif
#if HAS_ROUGH_GLASS
  bsdf.glass = black;
  bsdf.glass_color = vec3(1.0f, 1.0f, 1.0f);
  bsdf.glass_albedo = 1.0f;
  bsdf.ior_from = 1.0f;
  bsdf.ior_to = 1.0f;
#endif
#if HAS_SHEEN
  bsdf.sheen = black;
  bsdf.sheen_roughness = 1.0f;
  bsdf.sheen_albedo = vec4(0.0f, 0.0f, 0.0f, 0.0f);
#endif
#if HAS_THIN
  bsdf.thin = black;
#endif
#if HAS_TRANSLUCENT
  bsdf.translucent = black;
#endif
#if HAS_ANISOTROPY
  bsdf.widths = vec2(0.0f, 0.0f);
#endif
#if HAS_FILM
  bsdf.film = no_film();
#endif
#if HAS_ADJOINT
  bsdf.adjoint = false;
#endif
  return bsdf;
}

SHADER_END
#endif
