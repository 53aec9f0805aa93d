#include <cmath>

#include "host/materials/highlight.hpp"
#include "host/materials/make.hpp"
#include "host/materials/medium_keys.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

namespace {

constexpr std::string_view manual =
    R"(Glass, water, air: a clear medium that fills its shape. At its surface light is mirrored and refracted by the
shares of Fresnel's equations for unpolarised light; inside, `absorption` dims it with the distance (Beer–Lambert).

```toml
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
absorption = [0.2, 0.02, 0.1]
```

With `scattering` it is clouded: under `path` light that comes a distance d through it is weakened by exp(-(absorption +
scattering) d), and what is scattered goes on in directions after Henyey and Greenstein, p(cos θ) = (1 - g²) / (4π (1 + g² -
2g cos θ)^(3/2)), g the `anisotropy`. Each time counts as one of `max_depth`. `whitted` and `raycast` know `absorption` alone.
A medium without a surface has `ior = 1`: where the index is the same on both sides, paths and shadow rays go straight
through, weakened by the medium.

Media nest, up to four deep: a ray that leaves one is back in the one around it. A hollow ball is a sphere of glass with a
sphere of `ior = 1` inside it. From ior n₁ to n₂, sin²θ₂ = (n₁/n₂)² (1 − cos²θ₁); where that reaches 1 all light is mirrored, and
no root is taken. The reflected share is ½ (rₛ² + rₚ²), rₛ = (n₁cosθ₁ − n₂cosθ₂) / (n₁cosθ₁ + n₂cosθ₂),
rₚ = (n₁cosθ₂ − n₂cosθ₁) / (n₁cosθ₂ + n₂cosθ₁); equal media do not mirror at all.

With `thin` it is a pane, which has no inside: light that is mirrored to and fro between its faces adds up, R' = 2R / (1 + R), and the
rest goes straight on. Under `path` lights shine through panes: suns, points and spots through any number of them, those with a size through eight.
Paths find what lies behind more.

Shadow rays go straight through and keep the share `shadow` for each shape that they hit, however often they cross it
(a triangle is a shape). By default it is what a surface with air lets through at right angles,
1 − ((ior − 1) / (ior + 1))². Bent light (caustics) and its absorption are not modelled.

**Source.** Born, Wolf: Principles of Optics, 1.5. Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980.
)";

constexpr Key keys[] = {
    {.name = "ior",
     .type = KeyType::number,
     .doc = "Index of refraction.",
     .fallback = "1.5",
     .min = 1,
     .max = 4},
    {.name = "thin",
     .type = KeyType::boolean,
     .doc = "Whether it is a pane: a surface without inside, such as a window or a bubble.",
     .fallback = "false"},
    {.name = "roughness",
     .type = KeyType::texture,
     .doc = "Under `path`, of frosted glass: from 0, polished, to 1. The green channel counts. What is not 0 "
            "is at least 0.032.",
     .fallback = "0",
     .max = 1},
    absorption_key,
    scattering_key,
    anisotropy_key,
    {.name = "shadow",
     .type = KeyType::number,
     .doc = "Share of light that a shadow ray keeps for each shape it hits; from ior when absent.",
     .min = 0,
     .max = 1,
     .optional = true},
    specular_key,
    shininess_key,
    highlight_key,
};

class Dielectric final : public Material {
 public:
  explicit Dielectric(const DielectricValues& values) : values_(values) {}

  Scattering scattering(const ScatteringContext& context) const override {
    const double mirrored =
        values_.thin
            ? of_pane(optics::dielectric_reflectance(context.cos_view, context.ior_from, values_.ior))
            : optics::dielectric_reflectance(context.cos_view, context.ior_from, context.ior_to);
    Scattering scattering;
    scattering.reflected = Vec3(mirrored);
    scattering.transmitted = Vec3(1 - mirrored);
    values_.highlight.apply(context.place, scattering);
    return scattering;
  }

  Bsdf bsdf(const ScatteringContext& context, const Scattering& scattering) const override {
    Bsdf bsdf = Material::bsdf(context, scattering);
    bsdf.roughness = values_.roughness->at(context.place).y;
    if (values_.thin) {
      std::swap(bsdf.transmitted, bsdf.passed);
      if (bsdf.roughness == 0) return bsdf;
      const optics::Fresnel surface = optics::schlick(Vec3(1 - pane_transmittance()), Vec3(1));
      return {.layer = surface, .roughness = bsdf.roughness, .thin = Vec3(1)};
    }
    if (context.ior_from == context.ior_to)
      std::swap(bsdf.transmitted, bsdf.passed);
    else if (bsdf.roughness > 0) {
      bsdf.mirror = bsdf.transmitted = Vec3(0);
      bsdf.glass = Vec3(1);
      bsdf.ior_from = context.ior_from;
      bsdf.ior_to = context.ior_to;
    }
    return bsdf;
  }

  Vec3 base_color(const TextureContext&) const override { return Vec3(1); }

  std::optional<Medium> medium() const override {
    if (values_.thin) return std::nullopt;
    return Medium{values_.ior, values_.absorption, values_.scattering, values_.anisotropy};
  }
  bool thin() const override { return values_.thin; }

  double shadow_transmittance() const override {
    const double r = (values_.ior - 1) / (values_.ior + 1);
    return values_.shadow.value_or(values_.thin ? pane_transmittance() : 1 - r * r);
  }

  void pack(records::Packer& packer) const override {
    auto record = make_record(shader::MATERIAL_dielectric, values_.highlight, shadow_transmittance(), packer);
    if (values_.thin) {
      record.flags |= MATERIAL_PANE;
      record.a = shader::vec4(values_.ior, 1 - pane_transmittance(), 0, 0);
    } else {
      record.medium = packer.add_medium(*medium());
    }
    record.color = record.reflected = textures::make_constant(Vec3(1))->pack(packer);
    record.roughness = values_.roughness->pack(packer);
    packer.add(record);
    if (rough() && !values_.thin) packer.scene.lobes.insert(shader::LOBE_rough_glass);
    if (rough() && values_.thin)
      packer.scene.lobes.insert({shader::LOBE_glossy, shader::LOBE_multiple, shader::LOBE_thin});
  }

 private:
  // What both its faces mirror together, of what one does.
  static double of_pane(double mirrored) { return 2 * mirrored / (1 + mirrored); }
  double pane_transmittance() const {
    const double r = (values_.ior - 1) / (values_.ior + 1);
    return 1 - of_pane(r * r);
  }
  bool rough() const { return values_.roughness->constant() != Vec3(0); }

  DielectricValues values_;
};

std::unique_ptr<Material> parse(TableReader& table) {
  if (table.boolean("thin"))
    for (const char* inside : {"absorption", "scattering"})
      if (table.has(inside))
        table.error(inside, "a thin pane has no inside that absorbs; `principled` has panes of a colour");
  const Medium medium = read_medium(table, table.number("ior"));
  DielectricValues values{.ior = medium.ior,
                          .thin = table.boolean("thin"),
                          .roughness = table.texture("roughness"),
                          .absorption = medium.absorption,
                          .scattering = medium.scattering,
                          .anisotropy = medium.anisotropy,
                          .highlight = read_highlight(table)};
  if (table.has("shadow")) values.shadow = table.number("shadow");
  if (table.failed()) return nullptr;
  return make_dielectric(values);
}

}  // namespace

extern const MaterialType dielectric_type{
    .name = "dielectric", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Material> make_dielectric(const DielectricValues& values) {
  return std::make_unique<Dielectric>(values);
}

}  // namespace eyeray::engine::materials
