#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/materials/normal_map.hpp"
#include "host/materials/physical.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

extern const MaterialType principled_type;
extern const MaterialType plastic_type;

namespace {

constexpr std::string_view principled_manual =
    R"(The metallic-roughness model of glTF 2.0, which models come with. It is a coloured body under a clear, glossy
surface, a metal of that colour, or a blend of both. It may transmit light, and cloth and lacquer may lie on
top.

```toml
[[material]]
name = "car"
type = "principled"
color = [0.6, 0.02, 0.03]
metallic = 0.6
roughness = 0.4
coat = 1
```

The non-metal part reflects F0 = ((ior − 1) / (ior + 1))² · specular_color · specular at perpendicular
incidence, and `specular` at grazing incidence. A metal reflects `color` at perpendicular incidence, and white
at grazing incidence (Schlick). Microfacets are as in `conductor`.

Light that enters the non-metal part hits a Lambert body of `color`, and leaves through the surface again. The
share `transmission` of it passes through instead, tinted by `color`. It is refracted as in `dielectric` and
fills the shape. The surface of that share reflects by `ior` alone. Where the index is the same on both
sides, it continues straight, as in `dielectric`. Rough glass of a high `ior` is noisy, since it reflects most
light inside many times. With `thin` the light passes straight through, blurred by `roughness`. A coat has
index 1.5. Sheen is a layer of fibres of `sheen_color` above the body, as cloth has them. `whitted` and
`raycast` show an approximation: glass where `transmission` is 0.5 or more.

**Source.** Khronos: glTF 2.0 Specification, appendix B; KHR_materials_ior, _specular, _clearcoat, _sheen, _transmission, _volume. Kelemen,
Szirmay-Kalos: A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001. Estevez, Kulla: Production Friendly Microfacet
Sheen BRDF, SIGGRAPH 2017.
)";

constexpr std::string_view plastic_manual =
    R"(A coloured body under a clear surface, rough or polished: plastic, lacquer, glazed clay. It is `principled`
without a metal part.

```toml
[[material]]
name = "bowl"
type = "plastic"
color = [0.1, 0.3, 0.7]
roughness = 0.1
```
)";

constexpr Key color_key{
    .name = "color",
    .type = KeyType::texture,
    .doc = "Colour of the body. For a metal it is the reflectance at perpendicular incidence.",
    .fallback = "0.8",
    .max = 1};
constexpr Key ior_key{.name = "ior",
                      .type = KeyType::number,
                      .doc = "Index of refraction of the surface.",
                      .fallback = "1.5",
                      .min = 1,
                      .max = 4};

constexpr Key principled_keys[] = {
    color_key,
    {.name = "metallic",
     .type = KeyType::texture,
     .doc = "Share of the surface that is metal. The blue channel counts.",
     .fallback = "0",
     .max = 1},
    roughness_key,
    ior_key,
    {.name = "specular",
     .type = KeyType::texture,
     .doc = "Factor for the reflectance of the non-metal part. The red channel counts.",
     .fallback = "1",
     .max = 1},
    {.name = "specular_color",
     .type = KeyType::texture,
     .doc = "Tint of the reflectance of the non-metal part at perpendicular incidence.",
     .fallback = "1"},
    {.name = "transmission",
     .type = KeyType::texture,
     .doc = "Share of light that is transmitted, of the light that the non-metal part does not reflect. The "
            "red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "thin",
     .type = KeyType::boolean,
     .doc = "If true, the part that transmits light is a pane without an inside: a window, a leaf, a bubble.",
     .fallback = "false"},
    {.name = "absorption",
     .type = KeyType::color,
     .doc =
         "Absorption coefficient per world unit: inside, light is weakened by exp(-absorption * distance).",
     .fallback = "0"},
    {.name = "sheen_color",
     .type = KeyType::texture,
     .doc = "Colour of the fibres above the body; black means no fibres.",
     .fallback = "0",
     .max = 1},
    {.name = "sheen_roughness",
     .type = KeyType::texture,
     .doc = "Spread of the directions of the fibres: from 0 (sheen only at grazing angles) to 1 (all "
            "directions). The green channel counts. Values below 0.07 are raised to 0.07.",
     .fallback = "0.5",
     .max = 1},
    {.name = "coat",
     .type = KeyType::texture,
     .doc = "Share of the surface that a clear coat covers. The red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "coat_roughness",
     .type = KeyType::texture,
     .doc = "Roughness of the coat. The green channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "coat_normal",
     .type = KeyType::texture,
     .doc = "Normal map of the coat, in the form of `normal`. Neither `normal` nor `bump` bends the coat.",
     .max = 1,
     .optional = true},
    {.name = "coat_normal_scale",
     .type = KeyType::number,
     .doc = "Strength of `coat_normal`. A negative value bends the normals in the opposite direction.",
     .fallback = "1",
     .min = -1000,
     .max = 1000},
    emission_key,
};

constexpr Key plastic_keys[] = {color_key, roughness_key, ior_key, emission_key};

class Principled final : public Physical {
 public:
  Principled(const PrincipledValues& values, std::unique_ptr<Material> stand_in, uint32_t kind)
      : Physical(std::move(stand_in)),
        values_(values),
        kind_(kind),
        shown_as_glass_(Physical::medium() || Physical::thin()) {}

  std::optional<Medium> medium() const override {
    return transmits() && !values_.thin ? own_medium() : Physical::medium();
  }
  bool thin() const override { return transmits() && values_.thin; }
  bool emits() const override { return constant_emission() != Vec3(0); }
  std::optional<Vec3> constant_emission() const override { return values_.emission->constant(); }

  Scattering scattering(const ScatteringContext& context) const override {
    Scattering scattering = Physical::scattering(context);
    if (shown_as_glass_) scattering.emitted = values_.emission->at(context.point) * context.color;
    return scattering;
  }

  Vec3 base_color(const TextureContext& point) const override {
    return (shown_as_glass_ ? Physical::base_color(point) : values_.color->at(point)) +
           values_.emission->at(point);
  }

  Bsdf bsdf(const ScatteringContext& context, const Scattering&) const override {
    const Vec3 color = values_.color->at(context.point) * context.color;
    const double metallic = values_.metallic->at(context.point).z;
    const double level = values_.specular->at(context.point).x;
    const Vec3 f0 = mirrored(values_.specular_color->at(context.point), level), edge(level);
    const double through = values_.transmission->at(context.point).x * (1 - metallic);
    Bsdf bsdf{.diffuse = color * (1 - metallic - through),
              .layer = optics::schlick(f0, edge),
              .layered = 1 - metallic,
              .metal = optics::schlick(color, Vec3(1)),
              .metallic = metallic,
              .roughness = values_.roughness->at(context.point).y,
              .coat = values_.coat->at(context.point).x,
              .coat_roughness = values_.coat_roughness->at(context.point).y,
              .coat_normal = context.coat_normal,
              .sheen = values_.sheen->at(context.point),
              .sheen_roughness = values_.sheen_roughness->at(context.point).y};
    if (through == 0) return bsdf;
    if (values_.thin) {
      (bsdf.roughness == 0 ? bsdf.passed : bsdf.thin) = color * through;
      return bsdf;
    }
    bsdf.layered -= through;
    bsdf.ior_from = context.ior_from;
    bsdf.ior_to = context.ior_to;
    if (bsdf.roughness == 0 || context.ior_from == context.ior_to) {
      const double mirrored =
          optics::dielectric_reflectance(context.cos_view, context.ior_from, context.ior_to);
      bsdf.mirror = Vec3(through * mirrored);
      bsdf.transmitted = color * (through * (1 - mirrored));
    } else {
      bsdf.glass = Vec3(through);
      bsdf.glass_color = color;
    }
    return bsdf;
  }

  void pack(records::Packer& packer) const override {
    const uint32_t color = values_.color->pack(packer), metallic = values_.metallic->pack(packer),
                   roughness = values_.roughness->pack(packer), coat = values_.coat->pack(packer),
                   coat_roughness = values_.coat_roughness->pack(packer),
                   transmission = values_.transmission->pack(packer), sheen = values_.sheen->pack(packer),
                   sheen_roughness = values_.sheen_roughness->pack(packer),
                   emission = values_.emission->pack(packer);
    // Constant `specular` and `specular_color` are multiplied here; their textures are then white.
    const std::optional<Vec3> level = values_.specular->constant(), tint = values_.specular_color->constant();
    const TexturePtr white = textures::make_constant(Vec3(1));
    const uint32_t specular_level = (level ? white : values_.specular)->pack(packer);
    const uint32_t specular_color = (tint ? white : values_.specular_color)->pack(packer);
    shader::Material& record = pack_stand_in(kind_, packer);
    if (shown_as_glass_) {
      record.flags |= MATERIAL_CLEAR;
      record.base = color;
      record.a.x = float(own_medium().ior);
      record.emission = emission;
    } else {
      record.color = color;
      if (const auto filling = medium()) record.medium = packer.add_medium(*filling);
    }
    record.transmission = transmission;
    record.sheen = sheen;
    record.sheen_roughness = sheen_roughness;
    record.specular_level = specular_level;
    record.specular_color = specular_color;
    record.metallic = metallic;
    record.roughness = roughness;
    record.coat = coat;
    record.coat_roughness = coat_roughness;
    const double constant_level = level.value_or(Vec3(1)).x;
    record.b = records::to_vec4(mirrored(tint.value_or(Vec3(1)), constant_level), constant_level);
    packer.scene.lobes.insert({shader::LOBE_diffuse, shader::LOBE_glossy, shader::LOBE_multiple});
    std::set<uint32_t>& lobes = packer.scene.lobes;
    if (values_.coat->constant() != Vec3(0)) lobes.insert(shader::LOBE_coat);
    if (values_.sheen->constant() != Vec3(0)) lobes.insert(shader::LOBE_sheen);
    if (transmits() && values_.roughness->constant() != Vec3(0))
      lobes.insert(values_.thin ? shader::LOBE_thin : shader::LOBE_rough_glass);
  }

 private:
  bool transmits() const { return values_.transmission->constant() != Vec3(0); }
  Medium own_medium() const { return {.ior = std::max(1.0, values_.ior), .absorption = values_.absorption}; }
  // The reflectance of the non-metal part at perpendicular incidence.
  Vec3 mirrored(const Vec3& tint, double level) const {
    const double r = (values_.ior - 1) / (values_.ior + 1);
    return glm::min(Vec3(1), r * r * tint) * level;
  }

  PrincipledValues values_;
  uint32_t kind_;
  bool shown_as_glass_;  // whether the stand-in is glass
};

std::unique_ptr<Material> make(const PrincipledValues& values, std::unique_ptr<Material> stand_in_material,
                               uint32_t kind) {
  if (!stand_in_material && values.transmission->constant() != Vec3(0) &&
      values.transmission->constant().value_or(values.transmission->at(Vec2(0.5))).x >= 0.5) {
    stand_in_material = make_dielectric(
        {.ior = std::max(1.0, values.ior), .thin = values.thin, .absorption = values.absorption});
  }
  if (!stand_in_material) {
    const double metallic = values.metallic->constant().value_or(values.metallic->at(Vec2(0.5))).z;
    const double roughness = typical(*values.roughness), r = (values.ior - 1) / (values.ior + 1);
    const Vec3 color = values.color->constant().value_or(values.color->at(Vec2(0.5)));
    const Vec3 f0 = glm::mix(Vec3(r * r), color, metallic);
    const double scattered = 1 - metallic * (1 - roughness) * (1 - roughness);
    PhongValues phong =
        stand_in(scattered == 1 ? values.color : textures::make_constant(color * scattered), f0, roughness);
    phong.emission = values.emission;
    stand_in_material = make_phong(phong);
  }
  return std::make_unique<Principled>(values, std::move(stand_in_material), kind);
}

PrincipledValues read_body(const TableReader& table) {
  return {.color = table.texture("color"),
          .roughness = table.texture("roughness"),
          .ior = table.number("ior"),
          .emission = table.texture("emission")};
}

std::unique_ptr<Material> parse_principled(TableReader& table) {
  if (table.failed()) return nullptr;
  PrincipledValues values = read_body(table);
  values.metallic = table.texture("metallic");
  values.specular = table.texture("specular");
  values.specular_color = table.texture("specular_color");
  values.transmission = table.texture("transmission");
  values.thin = table.boolean("thin");
  values.absorption = table.color("absorption");
  values.sheen = table.texture("sheen_color");
  values.sheen_roughness = table.texture("sheen_roughness");
  if (values.thin && table.has("absorption"))
    table.error("absorption", "a thin pane has no inside that absorbs; tint it by its `color`");
  for (const char* key : {"thin", "absorption"})
    if (table.has(key) && !table.has("transmission"))
      table.error(key, fmt::format("`{}` applies to transmitted light, so it needs `transmission`", key));
  if (table.failed()) return nullptr;
  values.coat = table.texture("coat");
  values.coat_roughness = table.texture("coat_roughness");
  std::unique_ptr<Material> material = make(values, nullptr, shader::MATERIAL_principled);
  material->coat_normal_map = read_normal_map(table, "coat_normal", "coat_normal_scale");
  if (material->coat_normal_map && !table.has("coat"))
    table.error("coat_normal", "`coat_normal` needs a `coat`");
  return material;
}

std::unique_ptr<Material> parse_plastic(TableReader& table) {
  if (table.failed()) return nullptr;
  return make(read_body(table), nullptr, shader::MATERIAL_plastic);
}

}  // namespace

extern const MaterialType principled_type{
    .name = "principled", .manual = principled_manual, .keys = principled_keys, .parse = parse_principled};
extern const MaterialType plastic_type{
    .name = "plastic", .manual = plastic_manual, .keys = plastic_keys, .parse = parse_plastic};

std::unique_ptr<Material> make_principled(const PrincipledValues& values,
                                          std::unique_ptr<Material> stand_in) {
  return make(values, std::move(stand_in), shader::MATERIAL_principled);
}

}  // namespace eyeray::engine::materials
