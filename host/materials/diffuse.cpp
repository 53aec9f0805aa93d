#include "host/materials/physical.hpp"

#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

extern const MaterialType diffuse_type;

namespace {

constexpr std::string_view manual =
    R"(A matte surface: chalk, plaster, paper. With `roughness` it looks flatter, as the moon does. No light is lost
by that.

```toml
[[material]]
name = "plaster"
type = "diffuse"
color = [0.8, 0.75, 0.7]
roughness = 0.6
```

At roughness 0 the BSDF is color / π, Lambert's. At higher roughness it is Fujii's form of Oren and Nayar's
model, including the light that facets scatter onto each other. `whitted` and `raycast` use Lambert's.

**Source.** Portsmouth, Kutz, Hill: EON: A Practical Energy-Preserving Rough Diffuse BRDF, JCGT 14(1), 2025.
)";

constexpr Key keys[] = {
    {.name = "color",
     .type = KeyType::texture,
     .doc = "Share of light that is scattered.",
     .fallback = "0.8",
     .max = 1},
    {.name = "roughness",
     .type = KeyType::texture,
     .doc = "Roughness from 0 (Lambert's) to 1. The green channel counts.",
     .fallback = "0",
     .max = 1},
    emission_key,
};

class Diffuse final : public Physical {
 public:
  Diffuse(const PhongValues& stand_in, const TexturePtr& roughness)
      : Physical(make_phong(stand_in)), roughness_(roughness) {}

  Bsdf bsdf(const ScatteringContext& context, const Scattering& scattering) const override {
    return {.diffuse = scattering.diffuse, .diffuse_roughness = roughness_->at(context.point).y};
  }

  void pack(records::Packer& packer) const override {
    const uint32_t roughness = roughness_->pack(packer);
    pack_stand_in(shader::MATERIAL_diffuse, packer).roughness = roughness;
  }

 private:
  TexturePtr roughness_;
};

std::unique_ptr<Material> parse(TableReader& table) {
  if (table.failed()) return nullptr;
  return make_diffuse({table.texture("color"), table.texture("roughness"), table.texture("emission")});
}

}  // namespace

extern const MaterialType diffuse_type{.name = "diffuse", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Material> make_diffuse(const DiffuseValues& values) {
  return std::make_unique<Diffuse>(PhongValues{.diffuse = values.color, .emission = values.emission},
                                   values.roughness);
}

}  // namespace eyeray::engine::materials
