// Makes materials in code, for importers and tests; MaterialType makes those of scene files. Values have the
// meaning and the ranges of the keys of the same name.
#pragma once

#include <memory>
#include <optional>

#include "host/materials/highlight.hpp"
#include "host/optics/fresnel.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::materials {

struct PhongValues {
  TexturePtr diffuse = textures::make_constant(Vec3(0.8));
  TexturePtr ambient = nullptr;  // null: as diffuse
  TexturePtr reflectance = textures::make_constant(Vec3(0));
  TexturePtr emission = textures::make_constant(Vec3(0));
  Highlight highlight = {};
};
std::unique_ptr<Material> make_phong(const PhongValues& values);

struct MirrorValues {
  TexturePtr reflectance = textures::make_constant(Vec3(0.95));
  Highlight highlight = {};
};
std::unique_ptr<Material> make_mirror(const MirrorValues& values);

struct DielectricValues {
  double ior = 1.5;
  bool thin = false;
  TexturePtr roughness = textures::make_constant(Vec3(0));
  Vec3 absorption{0.0};
  Vec3 scattering{0.0};
  double anisotropy = 0;
  double dispersion = 0;
  std::optional<double> shadow = {};  // absent: Fresnel's transmittance at normal incidence
  Highlight highlight = {};
};
std::unique_ptr<Material> make_dielectric(const DielectricValues& values);

struct DiffuseValues {
  TexturePtr color = textures::make_constant(Vec3(0.8));
  TexturePtr roughness = textures::make_constant(Vec3(0));
  TexturePtr emission = textures::make_constant(Vec3(0));
};
std::unique_ptr<Material> make_diffuse(const DiffuseValues& values);

struct ConductorValues {
  optics::Fresnel index;       // a conductor's reflectance, used if `color` is null
  TexturePtr color = nullptr;  // replaces `index`, unless null
  TexturePtr roughness = textures::make_constant(Vec3(0.5));
};
std::unique_ptr<Material> make_conductor(const ConductorValues& values);

struct PrincipledValues {
  TexturePtr color = textures::make_constant(Vec3(0.8));
  TexturePtr metallic = textures::make_constant(Vec3(0));
  TexturePtr roughness = textures::make_constant(Vec3(0.5));
  double ior = 1.5;
  TexturePtr specular = textures::make_constant(Vec3(1));
  TexturePtr specular_color = textures::make_constant(Vec3(1));
  TexturePtr transmission = textures::make_constant(Vec3(0));
  bool thin = false;
  Vec3 absorption{0.0};
  double dispersion = 0;
  TexturePtr diffuse_transmission = textures::make_constant(Vec3(0));
  TexturePtr diffuse_transmission_color = textures::make_constant(Vec3(1));
  TexturePtr anisotropy = textures::make_constant(Vec3(0));  // along Material::rough_axis
  TexturePtr iridescence = textures::make_constant(Vec3(0));
  double iridescence_ior = 1.3;
  // The film's thickness in nanometres: from the first to the second one as the texture goes from 0 to 1.
  double iridescence_least = 100, iridescence_most = 400;
  TexturePtr iridescence_thickness = textures::make_constant(Vec3(1));
  TexturePtr sheen = textures::make_constant(Vec3(0));
  TexturePtr sheen_roughness = textures::make_constant(Vec3(0.5));
  TexturePtr coat = textures::make_constant(Vec3(0));
  TexturePtr coat_roughness = textures::make_constant(Vec3(0));
  TexturePtr emission = textures::make_constant(Vec3(0));
};
// `stand_in`: the material that Whitted's pictures show; null: one that is made from `values`.
std::unique_ptr<Material> make_principled(const PrincipledValues& values,
                                          std::unique_ptr<Material> stand_in = nullptr);

}  // namespace eyeray::engine::materials
