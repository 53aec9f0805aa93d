// The directional albedo of GGX, the same for all executors: data, in float64.
// Kulla, Conty: Revisiting Physically Based Shading at Imageworks, SIGGRAPH 2017.
#pragma once

#include <array>
#include <span>

namespace eyeray::optics {

// What microfacets of one roughness send on of the light from one direction, without what another of them
// takes.
struct GgxAlbedo {
  double once;       // each a perfect mirror
  double edge;       // the same, weighted by Schlick's (1 − cosine)⁵ at the microfacet
  double mean_once;  // over the half sphere, by cosine; the same for all directions
  double mean_edge;
};

inline constexpr int ggx_albedos = 64;  // a side of the table

// By roughness j and √cosine i, both in steps of 1 / 63, at j · 64 + i. Computed when first asked for, by
// quadrature over the microfacets that are seen.
std::span<const GgxAlbedo> ggx_albedo_table();

// At a cosine and a roughness in [0, 1], bilinear in √cosine and roughness: within 4e-3, where both are above
// 0.01 and 0.05.
GgxAlbedo ggx_albedo(double cosine, double roughness);

// By quadrature: of one direction, without means.
GgxAlbedo ggx_albedo_integral(double cosine, double roughness);

}  // namespace eyeray::optics
