// Directional albedos of lobes, the same for all executors: data, in float64, that is computed while eyeray
// is built (cmake/tables.cpp). Each table has rows by roughness, and in a row entries by √cosine, both in
// even steps from 0 to 1.
#pragma once

#include <span>

#include "host/optics/ggx_albedo.hpp"
#include "host/optics/sheen_albedo.hpp"

namespace eyeray::engine::tables {

inline constexpr int ggx_side = 64, sheen_side = 32, glass_side = 32;  // rows, and entries in each

// Rough glass has a table at each end of these slices. They divide the root of the contrast
// (n₂ − n₁) / (n₂ + n₁) of its indices evenly on either side of 0, since edge-on most changes where the
// indices are nearly the same. More slices are below 0, where some light is reflected totally.
inline constexpr int glass_slices = 24, glass_slices_below = 14;
inline constexpr double most_contrast = 0.6;  // that of the indices 1 and 4
constexpr double glass_contrast(int end) {
  const double above = end - glass_slices_below;
  const double root = above / (above < 0 ? glass_slices_below : glass_slices - glass_slices_below);
  return (above < 0 ? -most_contrast : most_contrast) * root * root;
}

std::span<const optics::GgxAlbedo> ggx_albedos();
std::span<const optics::SheenAlbedo> sheen_albedos();
// The albedos of glass at the end 0 … glass_slices of a slice.
std::span<const double> glass_albedos(int end);

// Albedos at a cosine and a roughness in [0, 1], linear between the tables' entries. They are within 4e-3 if
// the cosine is above 0.02 and the roughness above 0.05.
optics::GgxAlbedo ggx_albedo(double cosine, double roughness);
optics::SheenAlbedo sheen_albedo(double cosine, double roughness);
double glass_albedo(double cosine, double roughness, double ior_from, double ior_to);

}  // namespace eyeray::engine::tables
