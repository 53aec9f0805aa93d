#include <cmath>

#include "host/materials/highlight.hpp"
#include "host/materials/make.hpp"
#include "host/materials/medium_keys.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

namespace {

constexpr std::string_view manual =
    R"(Glass, water, air: a clear medium that fills its shape. The surface reflects and refracts light by Fresnel's
equations for unpolarised light. Inside, `absorption` weakens light with the distance (Beer–Lambert).

```toml
[[material]]
name = "glass"
type = "dielectric"
ior = 1.5
absorption = [0.2, 0.02, 0.1]
```

With `scattering` the medium is cloudy. Under `path`, a distance d through it weakens light by
exp(-(absorption + scattering) d). Scattered light continues in directions after Henyey and Greenstein, p(cos
θ) = (1 - g²) / (4π (1 + g² - 2g cos θ)^(3/2)), where g is the `anisotropy`. Each scattering counts as one of
`max_depth`. `whitted` and `raycast` use only `absorption`. A medium without a visible surface has `ior = 1`.
Where the index is the same on both sides, paths and shadow rays continue straight, weakened by the medium.

Media nest, up to four deep: a ray that leaves a medium is back in the surrounding one. A hollow ball is a
sphere of glass with a sphere of `ior = 1` inside it. From ior n₁ to n₂, sin²θ₂ = (n₁/n₂)² (1 − cos²θ₁). Where
that reaches 1, all light is reflected and no root is taken. The reflected share is ½ (rₛ² + rₚ²), with rₛ =
(n₁cosθ₁ − n₂cosθ₂) / (n₁cosθ₁ + n₂cosθ₂) and rₚ = (n₁cosθ₂ − n₂cosθ₁) / (n₁cosθ₂ + n₂cosθ₁). Two equal media
do not reflect at all.

With `dispersion`, a path that hits the glass continues with the light of one colour channel, chosen at random.
Green is refracted by `ior`. Red takes the index of the C line, `ior` − (`ior` − 1) · `dispersion` / 40, and blue that of
the F line, as far above `ior`.

With `thin` the surface is a pane, which has no inside. The reflections between its two faces add up to R' =
2R / (1 + R). The rest of the light continues straight. Under `path`, lights shine through panes. The light of
directional, point and spot lights without a size passes any number of them. The light of those with a size
passes eight. Paths find lights behind more panes.

Shadow rays pass straight through. Each shape that they hit multiplies the light by `shadow` once, however
often they cross the shape (a triangle is a shape). The default is the transmittance of a surface in air at
perpendicular incidence, 1 − ((ior − 1) / (ior + 1))². Refracted light (caustics) and its absorption are not
modelled.

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
     .doc = "If true, the surface is a pane without an inside, such as a window or a bubble.",
     .fallback = "false"},
    {.name = "roughness",
     .type = KeyType::texture,
     .doc = "Roughness of frosted glass under `path`, from 0 (polished) to 1. The green channel counts. "
            "Values above 0 and below 0.032 are raised to 0.032.",
     .fallback = "0",
     .max = 1},
    absorption_key,
    scattering_key,
    anisotropy_key,
    dispersion_key,
    {.name = "shadow",
     .type = KeyType::number,
     .doc = "Factor for the light of a shadow ray, once for each shape that it hits. When absent, it follows "
            "from `ior`.",
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
    values_.highlight.apply(context.point, scattering);
    return scattering;
  }

  Bsdf bsdf(const ScatteringContext& context, const Scattering& scattering) const override {
    Bsdf bsdf = Material::bsdf(context, scattering);
    bsdf.roughness = values_.roughness->at(context.point).y;
    if (values_.thin) {
      std::swap(bsdf.transmitted, bsdf.passed);
      if (bsdf.roughness == 0) return bsdf;
      const optics::Fresnel surface = optics::schlick(Vec3(1 - pane_transmittance()), Vec3(1));
      return {.layer = surface, .roughness = bsdf.roughness, .thin = Vec3(1)};
    }
    if (bsdf.roughness > 0 && context.ior_from != context.ior_to) {
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
    return Medium{values_.ior, values_.absorption, values_.scattering, values_.anisotropy,
                  values_.dispersion};
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
  // The reflectance of both faces together, from that of one.
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
        table.error(inside, "a thin pane has no inside that absorbs; use `principled` for coloured panes");
  if (table.boolean("thin") && table.has("dispersion"))
    table.error("dispersion",
                "a thin pane bends no light, so it has no dispersion; remove one of the two keys");
  const Medium medium = read_medium(table, table.number("ior"));
  DielectricValues values{.ior = medium.ior,
                          .thin = table.boolean("thin"),
                          .roughness = table.texture("roughness"),
                          .absorption = medium.absorption,
                          .scattering = medium.scattering,
                          .anisotropy = medium.anisotropy,
                          .dispersion = table.number("dispersion"),
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
