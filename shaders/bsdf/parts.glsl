// A BSDF in two parts: its wide lobes, on which photons are gathered, and the sharp ones, by which a path goes on.
#ifndef PARTS_GLSL
#define PARTS_GLSL
#include "bsdf/bsdf.glsl"

SHADER_BEGIN

#define LEAST_WIDE 0.32f  // roughness: microfacets of α = 0.1

#define IS_WIDE_diffuse(bsdf) true
#define IS_WIDE_glossy(bsdf) (bsdf.roughness >= LEAST_WIDE)
#define IS_WIDE_multiple(bsdf) (bsdf.roughness >= LEAST_WIDE)
#define IS_WIDE_coat(bsdf) (bsdf.coat_roughness >= LEAST_WIDE)
#define IS_WIDE_rough_glass(bsdf) (bsdf.roughness >= LEAST_WIDE)
#define IS_WIDE_sheen(bsdf) true
#define IS_WIDE_thin(bsdf) (bsdf.roughness >= LEAST_WIDE)
#define IS_WIDE_translucent(bsdf) true

// The probability of following each lobe of the part, out of all lobes: the sum is less than 1.
LobeShares part_of(Bsdf bsdf, bool wide) {
  LobeShares shares = lobe_shares(bsdf);
#define KEEP_LOBE(name, number, layers) shares.name = IS_WIDE_##name(bsdf) == wide ? shares.name : 0.0f;
  LOBES(KEEP_LOBE)
  shares.mirror = wide ? 0.0f : shares.mirror;
  shares.transmitted = wide ? 0.0f : shares.transmitted;
#if HAS_PANES
  shares.passed = wide ? 0.0f : shares.passed;
#endif
  return shares;
}

float sum_of(LobeShares shares) {
  float sum = shares.mirror + shares.transmitted;
#if HAS_PANES
  sum = sum + shares.passed;
#endif
#define ADD_SHARE(name, number, layers) sum = sum + shares.name;
  LOBES(ADD_SHARE)
  return sum;
}

SHADER_END
#endif
