// Light that is scattered within: rough diffuse, of roughness 0 Lambert's, under a layer that mirrors its part. Portsmouth, Kutz and
// Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF" (JCGT 2025); the layer's coupling is Kelemen and Szirmay-Kalos', "A
// Microfacet Based Coupled Specular-Matte BRDF Model" (Eurographics 2001).
#ifndef DIFFUSE_GLSL
#define DIFFUSE_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

#define FUJII_A 0.28779342f     // 1/2 − 2/(3π)
#define FUJII_MEAN 0.07248821f  // 2/3 − 28/(15π)

// The directional albedo of a Fujii–Oren–Nayar surface of albedo 1, for light that arrives under that cosine.
float fujii_albedo(float cosine, float roughness) {
  float sine = sqrt(maximum(1.0f - cosine * cosine, 0.0f));
  float angle = atan_yx(sine, cosine);
  float g = sine * (angle - sine * cosine) +
            (2.0f / 3.0f) * (sine * cosine * (1.0f + sine + sine * sine) / (1.0f + sine) - sine);
  return (1.0f + roughness * (g / PI)) / (1.0f + FUJII_A * roughness);
}

// The albedo of light that the layer above lets in, for choosing.
vec3 diffuse_albedo(Bsdf bsdf) {
  vec3 albedo = bsdf.diffuse;
#if HAS_GLOSSY
  albedo = albedo * (vec3(1.0f, 1.0f, 1.0f) - layer_albedo(bsdf.layer, bsdf.albedo));
#endif
  return albedo;
}

LobeValue diffuse_value(Bsdf bsdf, Directions at) {
  float cosine = maximum(at.i.z, 0.0f);
  vec3 albedo = bsdf.diffuse;
#if HAS_ROUGH_DIFFUSE
  float r = bsdf.diffuse_roughness;
  float a = 1.0f / (1.0f + FUJII_A * r);
  float s = dot3(at.i, at.o) - at.i.z * at.o.z;
  float t = s > 0.0f ? maximum(maximum(at.i.z, at.o.z), 1.0e-6f) : 1.0f;
  float mean = a * (1.0f + FUJII_MEAN * r);
  vec3 often = bsdf.diffuse * bsdf.diffuse * mean / (vec3(1.0f, 1.0f, 1.0f) - bsdf.diffuse * (1.0f - mean));
  float rest = (1.0f - fujii_albedo(cosine, r)) * (1.0f - fujii_albedo(at.o.z, r)) / maximum(1.0f - mean, 1.0e-7f);
  albedo = r > 0.0f ? bsdf.diffuse * (a * (1.0f + r * (s / t))) + often * rest : bsdf.diffuse;
#endif
#if HAS_GLOSSY
  albedo = under_layer(bsdf, at, albedo);
#endif
  LobeValue result;
  result.density = cosine / PI;
  result.value = albedo * result.density;
  return result;
}

vec3 diffuse_direction(Bsdf bsdf, vec3 o, vec2 u, float part) { return cosine_direction(u); }

SHADER_END
#endif
