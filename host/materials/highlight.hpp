// The highlight of a light, which every material may show, and the parts of the record that all materials
// share.
#pragma once

#include "host/materials/registry.hpp"
#include "host/records/packer.hpp"
#include "host/scene/material.hpp"
#include "host/textures/make.hpp"

namespace eyeray::engine::materials {

struct Highlight {
  TexturePtr specular = textures::make_constant(Vec3(0));
  double shininess = 32;
  bool blinn = false;

  // Fills the highlight's part of a Scattering.
  void apply(const TextureContext& point, Scattering& scattering) const;
};

// The keys that a material with a highlight declares, and the function that reads them.
inline constexpr Key specular_key{
    .name = "specular", .type = KeyType::texture, .doc = "Share of light in the highlight.", .fallback = "0"};
inline constexpr Key shininess_key{
    .name = "shininess",
    .type = KeyType::number,
    .doc = "Exponent of the highlight. A greater value makes the highlight smaller and sharper.",
    .fallback = "32",
    .min = 1,
    .max = 10000};
inline constexpr std::string_view highlight_models[] = {"phong", "blinn"};
inline constexpr Key highlight_key{
    .name = "highlight",
    .type = KeyType::choice,
    .doc = "Lobe of the highlight: (r·v)^shininess of Phong 1975 or (n·h)^shininess of Blinn 1977.",
    .fallback = "\"phong\"",
    .choices = highlight_models};
Highlight read_highlight(const TableReader& table);

// The record of a material of `kind`, with its highlight and its optical depth; base, reflected, ambient
// and emission are black, and it has no medium.
shader::Material make_record(uint32_t kind, const Highlight& highlight, double shadow_transmittance,
                             records::Packer& packer);

}  // namespace eyeray::engine::materials
