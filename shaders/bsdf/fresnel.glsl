// The share of light that a surface mirrors, by the cosine to its normal.
#ifndef FRESNEL_GLSL
#define FRESNEL_GLSL
#include "math/math.glsl"

SHADER_BEGIN

// Schlick's reflectance from f0 at normal incidence to f90 edge-on, or that of a conductor of index f0 + i f90.
struct Fresnel {
  vec3 f0;
  vec3 f90;
  vec3 mean;  // over the half sphere, by cosine
  bool conductor;
};

float fifth_power(float x) { return (x * x) * (x * x) * x; }

Fresnel schlick(vec3 f0, vec3 f90) {
  Fresnel fresnel;
  fresnel.f0 = f0;
  fresnel.f90 = f90;
  fresnel.mean = f0 + (f90 - f0) * (1.0f / 21.0f);
  fresnel.conductor = false;
  return fresnel;
}

// Born and Wolf, Principles of Optics, 14.2, in the form of Lazányi and Szirmay-Kalos' appendix (WSCG 2005): no complex numbers.
float conductor_reflectance(float n, float k, float cosine) {
  float c = cosine * cosine;
  float s = 1.0f - c;
  float t = n * n - k * k - s;
  float ab = sqrt(t * t + 4.0f * (n * n) * (k * k));
  float a = sqrt(maximum(0.5f * (ab + t), 0.0f));
  float crossed = (ab + c - 2.0f * a * cosine) / (ab + c + 2.0f * a * cosine);
  float parallel = crossed * (c * ab + s * s - 2.0f * a * cosine * s) / (c * ab + s * s + 2.0f * a * cosine * s);
  return 0.5f * (crossed + parallel);
}

vec3 mirrored_share(Fresnel fresnel, float cosine) {
  vec3 share = fresnel.f0 + (fresnel.f90 - fresnel.f0) * fifth_power(1.0f - cosine);
#if HAS_CONDUCTORS
  if (fresnel.conductor)
    share = vec3(conductor_reflectance(fresnel.f0.x, fresnel.f90.x, cosine), conductor_reflectance(fresnel.f0.y, fresnel.f90.y, cosine),
                 conductor_reflectance(fresnel.f0.z, fresnel.f90.z, cosine));
#endif
  return share;
}

// Reflectance of unpolarised light between two media, from the cosines of both directions.
float fresnel_of_cosines(float cos_from, float cos_to, float ior_from, float ior_to) {
  float parallel = (ior_to * cos_from - ior_from * cos_to) / (ior_to * cos_from + ior_from * cos_to);
  float crossed = (ior_from * cos_from - ior_to * cos_to) / (ior_from * cos_from + ior_to * cos_to);
  return 0.5f * (parallel * parallel + crossed * crossed);
}

// 1 under total internal reflection, which is decided before any square root.
float fresnel_reflectance(float cos_from, float ior_from, float ior_to) {
  float eta = ior_from / ior_to;
  float cos_squared = 1.0f - eta * eta * (1.0f - cos_from * cos_from);
  if (cos_squared <= 0.0f) return 1.0f;
  return fresnel_of_cosines(cos_from, sqrt(cos_squared), ior_from, ior_to);
}

SHADER_END
#endif
