// A rough pane, infinitely thin: light goes through it without being bent, and is blurred as if mirrored to the other side
// (KHR_materials_transmission). Light that its microfacets reflect at each other goes through evenly, but for the mirrored share.
#ifndef THIN_GLSL
#define THIN_GLSL
#include "bsdf/facets.glsl"
#include "bsdf/multiple.glsl"

SHADER_BEGIN

vec3 thin_albedo(Bsdf bsdf) { return bsdf.thin * (vec3(1.0f, 1.0f, 1.0f) - layer_albedo(bsdf.layer, bsdf.albedo)); }

// The share of directions that are mirrored to the other side: about that of their light in all light that goes through.
float thin_mirrored(Bsdf bsdf) {
  vec3 one = vec3(1.0f, 1.0f, 1.0f);
  float all = max_component(one - layer_albedo(bsdf.layer, bsdf.albedo));
  float scattered = max_component(one - mirrored_often(bsdf.layer, bsdf.albedo)) * bsdf.albedo.x;
  return 1.0f - minimum(scattered / maximum(all, 1.0e-20f), 1.0f);
}

LobeValue thin_value(Bsdf bsdf, Directions at) {
  LobeValue result = no_value();
  if (at.i.z < 0.0f) {
    vec3 one = vec3(1.0f, 1.0f, 1.0f);
    vec3 mirrored = vec3(at.i.x, at.i.y, -at.i.z);
    vec3 h = at.o + mirrored;
    h = h / sqrt(maximum(dot3(h, h), 1.0e-30f));
    vec2 reflection = ggx_reflection(at.o, mirrored, h, facets_of(bsdf));
    float even = -at.i.z / PI;
    float rest = bsdf.albedo.x * at.albedo.x / maximum(bsdf.albedo.z, 1.0e-20f);
    result.value = bsdf.thin * ((one - layer_share(bsdf, dot3(at.o, h))) * reflection.x +
                                (one - mirrored_often(bsdf.layer, bsdf.albedo)) * (rest * even));
    float share = thin_mirrored(bsdf);
    result.density = share * reflection.y + (1.0f - share) * between_facets_density(bsdf.roughness, -at.i.z);
  }
  return result;
}

vec3 thin_direction(Bsdf bsdf, vec3 o, vec2 u, float part) {
  float share = thin_mirrored(bsdf);
  vec3 i = between_facets_direction(bsdf.roughness, u, (part - share) / maximum(1.0f - share, 1.0e-20f));
  if (part < share) i = mirror3(o, ggx_normal(o, facets_of(bsdf), u));
  return i.z > 0.0f ? vec3(i.x, i.y, -i.z) : vec3(0.0f, 0.0f, 0.0f);
}

SHADER_END
#endif
