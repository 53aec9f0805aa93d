// Sheen, and its directional albedo by quadrature.
// Estevez, Kulla: Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017.
#pragma once

#include <vector>

namespace eyeray::engine::optics {

// Edge-on, the formula would scatter more light than arrives: `unweakened`. The BSDF is divided by the larger
// of that value for the light's and for the viewer's direction, if it is above 1. `albedo` is the result.
struct SheenAlbedo {
  double unweakened;
  double albedo;
};

inline constexpr double least_sheen_roughness = 0.07;

// The BSDF at half-way vectors of that cosine, without the weakening.
double sheen(double cosine_half_way, double cosine_o, double cosine_i, double roughness);
// The albedos of `places` directions, in even steps of √cosine from 0 to 1, for a roughness in [0, 1].
std::vector<SheenAlbedo> sheen_albedo_row(int places, double roughness);

}  // namespace eyeray::engine::optics
