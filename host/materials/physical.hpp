// Common parts of materials made for paths. Whitted's pictures show a stand-in of them.
#pragma once

#include "host/materials/make.hpp"
#include "host/materials/registry.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::materials {

class Physical : public Material {
 public:
  explicit Physical(std::unique_ptr<Material> stand_in) : stand_in_(std::move(stand_in)) {}

  Scattering scattering(const ScatteringContext& context) const override {
    return stand_in_->scattering(context);
  }
  Vec3 base_color(const TextureContext& point) const override { return stand_in_->base_color(point); }
  std::optional<Medium> medium() const override { return stand_in_->medium(); }
  bool thin() const override { return stand_in_->thin(); }
  double shadow_transmittance() const override { return stand_in_->shadow_transmittance(); }
  bool emits() const override { return stand_in_->emits(); }
  std::optional<Vec3> constant_emission() const override { return stand_in_->constant_emission(); }

 protected:
  // Packs the stand-in's record, and changes the record's kind to `kind`.
  shader::Material& pack_stand_in(uint32_t kind, records::Packer& packer) const {
    stand_in_->pack(packer);
    packer.scene.materials.back().kind = kind;
    return packer.scene.materials.back();
  }

 private:
  std::unique_ptr<Material> stand_in_;
};

// The stand-in, in Whitted's pictures, of a surface whose reflectance at normal incidence is f0: the smoother
// it is, the more it mirrors its surroundings. Each light shows a Blinn highlight of exponent 2 / roughness⁴
// − 2 (Karis: Specular BRDF Reference, 2013). `body`: the colour of the light that is not mirrored.
PhongValues stand_in(const TexturePtr& body, const Vec3& f0, double roughness);

// The typical value of a texture of numbers in [0, 1]: if the texture varies, the value in its middle.
double typical(const Texture& texture);

// The keys that materials made for paths share.
inline constexpr Key roughness_key{
    .name = "roughness",
    .type = KeyType::texture,
    .doc =
        "Roughness from 0 (polished) to 1. The slopes of the microfacets follow its square. The green "
        "channel counts. Values below 0.032 are raised to 0.032.",
    .fallback = "0.5",
    .max = 1};
inline constexpr Key emission_key{
    .name = "emission",
    .type = KeyType::texture,
    .doc = "Light that the surface emits, whatever shines on it. Under `path` it illuminates other surfaces.",
    .fallback = "0"};

}  // namespace eyeray::engine::materials
