// The directional albedo of GGX, by quadrature.
// Kulla, Conty: Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017.
#pragma once

#include <vector>

namespace eyeray::engine::optics {

// The share of light from one direction that microfacets of one roughness reflect, without the light that
// another microfacet blocks.
struct GgxAlbedo {
  double once;       // each a perfect mirror
  double edge;       // the same, weighted by Schlick's (1 − cosine)⁵ at the microfacet
  double mean_once;  // over the half sphere, by cosine; the same for all directions
  double mean_edge;
};

// The albedo of one direction, over the microfacets seen from there, without means. Both arguments are in
// [0, 1].
GgxAlbedo ggx_albedo_integral(double cosine, double roughness);
// The albedos of `places` directions, in even steps of √cosine from 0 to 1, with means.
std::vector<GgxAlbedo> ggx_albedo_row(int places, double roughness);

}  // namespace eyeray::engine::optics
