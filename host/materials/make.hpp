// Materials built in code, by importers and tests; a scene file's go through their MaterialType. Values have
// the meaning and the ranges of the keys of the same name.
#pragma once

#include <memory>
#include <optional>

#include "host/materials/highlight.hpp"
#include "host/scene/material.hpp"

namespace eyeray::materials {

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
  Vec3 absorption{0.0};
  std::optional<double> shadow = {};  // absent: what Fresnel lets through at normal incidence
  Highlight highlight = {};
};
std::unique_ptr<Material> make_dielectric(const DielectricValues& values);

}  // namespace eyeray::materials
