// What every medium is said by, whatever it fills.
#pragma once

#include "host/materials/registry.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::materials {

inline constexpr Key absorption_key = {
    .name = "absorption",
    .type = KeyType::color,
    .doc = "Light is weakened by exp(-absorption * distance) inside; per unit of length.",
    .fallback = "0"};
inline constexpr Key scattering_key = {
    .name = "scattering",
    .type = KeyType::color,
    .doc = "Under `path`, of milk, wax or fog: how much light is sent elsewhere inside; per unit of length.",
    .fallback = "0"};
inline constexpr Key anisotropy_key = {
    .name = "anisotropy",
    .type = KeyType::number,
    .doc =
        "Where to: the mean cosine of the angle by which scattered light is turned. Above 0 it goes on "
        "more or less as it came.",
    .fallback = "0",
    .min = -most_anisotropy,
    .max = most_anisotropy};

inline Medium read_medium(const TableReader& table, double ior) {
  return {ior, table.color("absorption"), table.color("scattering"), table.number("anisotropy")};
}

}  // namespace eyeray::engine::materials
