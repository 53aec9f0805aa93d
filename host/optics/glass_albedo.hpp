// The directional albedo of rough glass, the same for all executors: data, in float64.
// Turquin: Practical Multiple Scattering Compensation for Microfacet Models, 2019.
#pragma once

#include <span>

namespace eyeray::optics {

inline constexpr int glass_albedos = 32;  // a side of each table
inline constexpr int glass_slices = 16;  // of (n₂ − n₁) / (n₂ + n₁): twelve from −0.6 to 0, four to 0.6

// Which slice two indices lie in.
int glass_slice(double ior_from, double ior_to);
// What GGX microfacets between two media mirror and refract without what another of them takes, at the begin
// of a slice, or at the end of the last: by roughness j and √cosine i, both in steps of 1 / 31, at j · 32 +
// i. Each is computed when first asked for.
std::span<const double> glass_albedo_table(int slice);

// At a cosine and a roughness in [0, 1], trilinear.
double glass_albedo(double cosine, double roughness, double ior_from, double ior_to);

// By quadrature, in steps so many times `finer` than the tables'.
double glass_albedo_integral(double cosine, double roughness, double ior_from, double ior_to, int finer = 1);

}  // namespace eyeray::optics
