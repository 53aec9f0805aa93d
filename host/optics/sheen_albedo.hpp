// Sheen, and its directional albedo by quadrature.
// Estevez, Kulla: Production Friendly Microfacet Sheen BRDF, SIGGRAPH 2017.
#pragma once

#include <vector>

namespace eyeray::engine::optics {

// `unweakened` is the albedo by the formula alone. At grazing angles it can exceed 1: more light would
// be scattered than arrives. So the BSDF is divided by the larger `unweakened` of the light's and the
// viewer's direction, if that is above 1. `albedo` is the albedo after the division.
struct SheenAlbedo {
  double unweakened;
  double albedo;
};

inline constexpr double least_sheen_roughness = 0.07;

// The BSDF for half-way vectors of that cosine, before the division (SheenAlbedo).
double sheen(double cosine_half_way, double cosine_o, double cosine_i, double roughness);
// The albedos of `count` directions, in even steps of √cosine from 0 to 1, for a roughness in [0, 1].
std::vector<SheenAlbedo> sheen_albedo_row(int count, double roughness);

}  // namespace eyeray::engine::optics
