// The directional albedo of sheen, the same for all executors: data, in float64.
// Estevez, Kulla: Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017.
#pragma once

#include <span>

namespace eyeray::optics {

// Edge-on the formula would send on more light than comes: `unweakened`. It is divided by the larger of what
// that is on light's way and on the viewer's, where this is above 1: what is left then, of one direction and
// over the half sphere, by cosine.
struct SheenAlbedo {
  double unweakened;
  double albedo;
  double mean;
};

inline constexpr int sheen_albedos = 32;  // a side of the table
inline constexpr double least_sheen_roughness = 0.07;

// The BSDF at half-way vectors of that cosine, without the weakening.
double sheen(double cosine_half_way, double cosine_o, double cosine_i, double roughness);

// By roughness j and √cosine i, both in steps of 1 / 31, at j · 32 + i. Computed when first asked for.
std::span<const SheenAlbedo> sheen_albedo_table();

// At a cosine and a roughness in [0, 1], bilinear in √cosine and roughness.
SheenAlbedo sheen_albedo(double cosine, double roughness);

}  // namespace eyeray::optics
