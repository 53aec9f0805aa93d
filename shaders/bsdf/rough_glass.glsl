// A rough surface between two media, by microfacets that mirror and refract: Walter et al., "Microfacet Models for Refraction through Rough
// Surfaces" (EGSR 2007). For radiance / index², which refraction keeps. Light that its microfacets reflect at each other is given back to
// both lobes (Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", 2019), by the view direction; a photon's is i.
#ifndef ROUGH_GLASS_GLSL
#define ROUGH_GLASS_GLSL
#include "bsdf/facets.glsl"

SHADER_BEGIN

vec3 rough_glass_albedo(Bsdf bsdf) { return bsdf.glass; }

LobeValue rough_glass_value(Bsdf bsdf, Directions at) {
  FACETS width = facets_of(bsdf);
  bool through = at.i.z < 0.0f;
  float eta = bsdf.ior_to / bsdf.ior_from;
  // The microfacet that would send i to o.
  vec3 h = through ? at.o + at.i * eta : at.o + at.i;
  h = h / sqrt(maximum(dot3(h, h), 1.0e-30f));
  h = h.z < 0.0f ? -h : h;
  float along_o = dot3(at.o, h);
  float along_i = dot3(at.i, h);
  bool possible = along_o > 0.0f && (through ? along_i < 0.0f : along_i > 0.0f);

  // Both directions of transmitted light are known: at the critical angle Snell's law would lose all digits of one.
  float mirrored = through ? fresnel_of_cosines(along_o, -along_i, bsdf.ior_from, bsdf.ior_to)
                           : fresnel_reflectance(minimum(along_o, 1.0f), bsdf.ior_from, bsdf.ior_to);
  float towards_o = 1.0f + ggx_lambda(at.o, width);
  float seen = ggx_density(h, width) * along_o / (towards_o * at.o.z);
  float q = along_i + along_o / eta;
  float jacobian = through ? (1.0f - mirrored) * abs(along_i) / maximum(q * q, 1.0e-30f) : mirrored / (4.0f * along_o);
  float once = bsdf.glass_albedo;
  if (bsdf.adjoint) once = glass_table(abs(at.i.z), bsdf.roughness, through ? bsdf.ior_to : bsdf.ior_from, through ? bsdf.ior_from : bsdf.ior_to);
  LobeValue result = no_value();
  if (possible) {
    result.density = seen * jacobian;
    result.value = bsdf.glass * (result.density * towards_o / ((towards_o + ggx_lambda(at.i, width)) * once));
    if (through) result.value = result.value * bsdf.glass_color;
  }
  return result;
}

vec3 rough_glass_direction(Bsdf bsdf, vec3 o, vec2 u, float part) {
  vec3 h = ggx_normal(o, facets_of(bsdf), u);
  float along = minimum(dot3(o, h), 1.0f);
  float mirrored = fresnel_reflectance(along, bsdf.ior_from, bsdf.ior_to);
  float ratio = bsdf.ior_from / bsdf.ior_to;
  float cos_squared = maximum(1.0f - ratio * ratio * (1.0f - along * along), 0.0f);
  vec3 refracted = h * (ratio * along - sqrt(cos_squared)) - o * ratio;
  bool reflects = part < mirrored;
  vec3 i = reflects ? mirror3(o, h) : normalize3(refracted);
  // Light that a microfacet scatters to the wrong side is lost: the density does not include it.
  return (i.z > 0.0f) == reflects ? i : vec3(0.0f, 0.0f, 0.0f);
}

SHADER_END
#endif
