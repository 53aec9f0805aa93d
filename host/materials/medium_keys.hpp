// The keys that every medium has, in a shape or around all shapes.
#pragma once

#include "host/materials/registry.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::materials {

inline constexpr Key absorption_key = {
    .name = "absorption",
    .type = KeyType::color,
    .doc = "Absorption coefficient per world unit: inside, light is weakened by exp(-absorption * distance).",
    .fallback = "0"};
inline constexpr Key scattering_key = {.name = "scattering",
                                       .type = KeyType::color,
                                       .doc =
                                           "Scattering coefficient per world unit, under `path`, for milk, "
                                           "wax or fog: how much light is scattered inside.",
                                       .fallback = "0"};
inline constexpr Key anisotropy_key = {
    .name = "anisotropy",
    .type = KeyType::number,
    .doc = "Mean cosine of the scattering angle. Above 0, light continues more or less in its direction.",
    .fallback = "0",
    .min = -most_anisotropy,
    .max = most_anisotropy};

// The medium around all shapes does not have this key.
inline constexpr Key dispersion_key = {
    .name = "dispersion",
    .type = KeyType::number,
    .doc =
        "Strength of the dispersion under `path`: 20 divided by the Abbe number, 0.33 for crown glass. `ior` "
        "is then the index for green light.",
    .fallback = "0",
    .min = 0,
    .max = 10};

inline Medium read_medium(const TableReader& table, double ior) {
  return {ior, table.color("absorption"), table.color("scattering"), table.number("anisotropy")};
}

}  // namespace eyeray::engine::materials
