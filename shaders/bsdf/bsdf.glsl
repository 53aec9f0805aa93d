// A surface's BSDF: its lobes together. One lobe chooses a direction; value and density are always those of all, so that no two can
// disagree.
#ifndef BSDF_GLSL
#define BSDF_GLSL
#include "bsdf/facets.glsl"
#include "bsdf/layers.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

Directions directions(Bsdf bsdf, vec3 o, vec3 i) {
  Directions at;
  at.o = o;
  at.i = i;
  at.half_way = half_way_of(o, i);
#if HAS_GLOSSY
  at.albedo = ggx_albedo(abs(i.z), bsdf.roughness);
#if HAS_ANISOTROPY
  if (bsdf.widths.x > 0.0f) at.albedo = facets_albedo(vec3(i.x, i.y, abs(i.z)), bsdf.widths, bsdf.roughness);
#endif
#if HAS_FILM
  at.layer = bsdf.layer;
  if (bsdf.film.share > 0.0f) at.layer = filmed(bsdf.film, bsdf.film.layer_f0, bsdf.film.layer_f90, bsdf.layer.mean, abs(i.z));
#endif
#endif
  return at;
}

// About the share of the light that all lobes send towards the viewer.
vec3 bsdf_albedo(Bsdf bsdf) {
  Layers left = layers_towards_viewer(bsdf);
  vec3 all = (bsdf.mirror + bsdf.transmitted) * under_layers(left, 2u);
#if HAS_PANES
  all = all + bsdf.passed;
#endif
#define ADD_ALBEDO(name, number, layers) all = all + name##_albedo(bsdf) * under_layers(left, layers);
  LOBES(ADD_ALBEDO)
  return vec3(minimum(all.x, 1.0f), minimum(all.y, 1.0f), minimum(all.z, 1.0f));
}

// True if light leaves in single directions alone.
bool is_specular(Bsdf bsdf) {
  bool any = false;
#define HAS_LOBE(name, number, layers) any = any || max_component(name##_albedo(bsdf)) > 0.0f;
  LOBES(HAS_LOBE)
  vec3 single = bsdf.mirror + bsdf.transmitted;
#if HAS_PANES
  single = single + bsdf.passed;
#endif
  return !any && max_component(single) > 0.0f;
}

// The probability of following each lobe, by the light that it scatters. The sum is 1, or all are 0.
struct LobeShares {
#define SHARE(name, number, layers) float name;
  LOBES(SHARE)
  float mirror;
  float transmitted;
#if HAS_PANES
  float passed;
#endif
};

LobeShares lobe_shares(Bsdf bsdf) {
  Layers left = layers_for_choice(bsdf);
  LobeShares shares;
  shares.mirror = max_component(bsdf.mirror) * under_layers(left, 2u);
  shares.transmitted = max_component(bsdf.transmitted) * under_layers(left, 2u);
  float all = shares.mirror + shares.transmitted;
#if HAS_PANES
  shares.passed = max_component(bsdf.passed);
  all = all + shares.passed;
#endif
#define ALBEDO_OF_LOBE(name, number, layers)                                      \
  shares.name = max_component(name##_albedo(bsdf)) * under_layers(left, layers); \
  all = all + shares.name;
  LOBES(ALBEDO_OF_LOBE)
  float scale = all > 0.0f ? 1.0f / all : 0.0f;
#define SCALE_SHARE(name, number, layers) shares.name = shares.name * scale;
  LOBES(SCALE_SHARE)
  shares.mirror = shares.mirror * scale;
  shares.transmitted = shares.transmitted * scale;
#if HAS_PANES
  shares.passed = shares.passed * scale;
#endif
  return shares;
}

#if HAS_BENT_COAT
// True if light from i shines on the coat.
bool coat_faces(Bsdf bsdf, vec3 i) { return bsdf.coat > 0.0f && into_coat(bsdf, i).z > 0.0f; }
#endif

// The sum of all lobes except those of a single direction. `before`: whether the light is in front of the surface. With a bent coat the
// light may be above the coat, and below the layer that it covers.
LobeValue bsdf_value(Bsdf bsdf, LobeShares shares, vec3 o, vec3 i, bool before) {
  Directions at = directions(bsdf, o, i);
  LobeValue all = no_value();
  Layers left = layers_between(bsdf, i);
#if HAS_BENT_COAT
#define COUNTS_LOBE(layers) ((layers) == 0u ? before : before == (i.z > 0.0f))
#else
#define COUNTS_LOBE(layers) true
#endif
#define ADD_VALUE(name, number, layers)                                                               \
  if (shares.name > 0.0f) {                                                                           \
    LobeValue of_lobe = name##_value(bsdf, at);                                                       \
    if (COUNTS_LOBE(layers)) all.value = all.value + of_lobe.value * under_layers(left, layers);      \
    all.density = all.density + of_lobe.density * shares.name;                                        \
  }
  LOBES(ADD_VALUE)
  return all;
}

#define LOBE_MIRROR 14u
#define LOBE_TRANSMITTED 15u
#define LOBE_PASSED 16u

// A direction that light may come from, in which the path goes on. The number `random`, in [0, 1), lies within the share of the
// chosen lobe. No direction, 0, stands for one that the surface itself blocks.
struct BsdfSample {
  vec3 i;
  bool mirrored;   // instead: the mirrored direction …
  bool refracted;  // … or the refracted one
  uint lobe;       // its number, or LOBE_
#if HAS_PANES
  bool passed;     // … or straight on
#endif
};

BsdfSample sample_bsdf(Bsdf bsdf, LobeShares shares, vec3 o, float random, vec2 u) {
  BsdfSample s;
  s.i = vec3(0.0f, 0.0f, 1.0f);
  s.lobe = 0u;
  float passed = 0.0f;
#define DIRECTION_OF_LOBE(name, number, layers)                          \
  if (shares.name > 0.0f && random >= passed) {                          \
    s.i = name##_direction(bsdf, o, u, (random - passed) / shares.name); \
    s.lobe = number;                                                     \
  }                                                                      \
  passed = passed + shares.name;
  LOBES(DIRECTION_OF_LOBE)
  s.mirrored = shares.mirror > 0.0f && random >= passed;
  passed = passed + shares.mirror;
  s.refracted = shares.transmitted > 0.0f && random >= passed;
#if HAS_PANES
  passed = passed + shares.transmitted;
  s.passed = shares.passed > 0.0f && random >= passed;
  s.refracted = s.refracted && !s.passed;
  s.mirrored = s.mirrored && !s.passed;
#endif
  s.mirrored = s.mirrored && !s.refracted;
  s.lobe = s.mirrored ? LOBE_MIRROR : s.refracted ? LOBE_TRANSMITTED : s.lobe;
#if HAS_PANES
  s.lobe = s.passed ? LOBE_PASSED : s.lobe;
#endif
  return s;
}

SHADER_END
#endif
