// The directional albedo of GGX, by quadrature.
// Kulla, Conty: Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017.
#pragma once

#include <vector>

namespace eyeray::engine::optics {

// The share of light from one direction that microfacets of one roughness reflect, without the light that
// another microfacet blocks.
struct GgxAlbedo {
  double once;  // if each microfacet is a perfect mirror
  double edge;  // the same, weighted by Schlick's (1 − cosine)⁵ at the microfacet
  // The means of `once` and `edge` over the half sphere, weighted by cosine: the same for all directions.
  double mean_once;
  double mean_edge;
};

// The albedo of one direction, integrated over the microfacets that are visible from there; its means are 0.
// Both arguments are in [0, 1].
GgxAlbedo ggx_albedo_integral(double cosine, double roughness);
// The albedos of `count` directions, in even steps of √cosine from 0 to 1, with means.
std::vector<GgxAlbedo> ggx_albedo_row(int count, double roughness);

}  // namespace eyeray::engine::optics
