#include <cmath>

#include "host/materials/physical.hpp"

namespace eyeray::materials {

extern const MaterialType principled_type;
extern const MaterialType plastic_type;

namespace {

constexpr std::string_view principled_manual =
    R"(glTF 2.0's metallic-roughness, which models come with: a coloured body under a clear, glossy surface, or a metal of that
colour, or a blend of both, and perhaps a coat of lacquer.

```toml
[[material]]
name = "car"
type = "principled"
color = [0.6, 0.02, 0.03]
metallic = 0.6
roughness = 0.4
coat = 1
```

Where it is no metal it mirrors F0 = ((ior − 1) / (ior + 1))² · specular_color · specular at right angles and `specular` edge-on; a
metal mirrors `color`, and white edge-on (Schlick). Microfacets are as in `conductor`. What the surface lets through meets a
Lambert body of `color`, and leaves through the surface again. A coat has index 1.5. `whitted` and `raycast` show a stand-in.

**Source.** Khronos: glTF 2.0 Specification, appendix B; KHR_materials_ior, _specular, _clearcoat. Kelemen, Szirmay-Kalos: A Microfacet
Based Coupled Specular-Matte BRDF Model, Eurographics 2001.
)";

constexpr std::string_view plastic_manual =
    R"(A coloured body under a clear surface, rough or polished: plastic, lacquer, glazed clay. It is `principled` of which no
part is metal.

```toml
[[material]]
name = "bowl"
type = "plastic"
color = [0.1, 0.3, 0.7]
roughness = 0.1
```
)";

constexpr Key color_key{.name = "color",
                        .type = KeyType::texture,
                        .doc = "Of the body; of a metal, the share that is mirrored at right angles.",
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
     .doc = "How much of it is metal. The blue channel counts.",
     .fallback = "0",
     .max = 1},
    roughness_key,
    ior_key,
    {.name = "specular",
     .type = KeyType::number,
     .doc = "Weakens what is mirrored where it is no metal.",
     .fallback = "1",
     .min = 0,
     .max = 1},
    {.name = "specular_color",
     .type = KeyType::color,
     .doc = "Tints what is mirrored at right angles where it is no metal.",
     .fallback = "1"},
    {.name = "coat",
     .type = KeyType::texture,
     .doc = "The share of the surface that a clear coat covers. The red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "coat_roughness",
     .type = KeyType::texture,
     .doc = "Of the coat. The green channel counts.",
     .fallback = "0",
     .max = 1},
    emission_key,
};

constexpr Key plastic_keys[] = {color_key, roughness_key, ior_key, emission_key};

class Principled final : public Physical {
 public:
  Principled(const PrincipledValues& values, std::unique_ptr<Material> stand_in, uint32_t kind)
      : Physical(std::move(stand_in)), values_(values), kind_(kind) {
    const double r = (values.ior - 1) / (values.ior + 1);
    f0_ = glm::min(Vec3(1), r * r * values.specular_color) * values.specular;
  }

  Vec3 base_color(const TextureContext& place) const override {
    return values_.color->at(place) + values_.emission->at(place);
  }

  Bsdf bsdf(const ScatteringContext& context, const Scattering&) const override {
    const Vec3 color = values_.color->at(context.place) * context.color;
    const double metallic = values_.metallic->at(context.place).z;
    const Vec3 edge(values_.specular);
    return {.diffuse = color * (1 - metallic),
            .layer = optics::schlick(f0_, edge),
            .glossy = optics::schlick(glm::mix(f0_, color, metallic), glm::mix(edge, Vec3(1), metallic)),
            .roughness = values_.roughness->at(context.place).y,
            .coat = values_.coat->at(context.place).x,
            .coat_roughness = values_.coat_roughness->at(context.place).y};
  }

  void pack(records::Packer& packer) const override {
    const uint32_t color = values_.color->pack(packer), metallic = values_.metallic->pack(packer),
                   roughness = values_.roughness->pack(packer), coat = values_.coat->pack(packer),
                   coat_roughness = values_.coat_roughness->pack(packer);
    shader::Material& record = pack_stand_in(kind_, packer);
    record.color = color;
    record.metallic = metallic;
    record.roughness = roughness;
    record.coat = coat;
    record.coat_roughness = coat_roughness;
    record.b = records::to_vec4(f0_, values_.specular);
    packer.scene.lobes.insert({shader::LOBE_diffuse, shader::LOBE_glossy, shader::LOBE_multiple});
    if (values_.coat->constant() != Vec3(0)) packer.scene.lobes.insert(shader::LOBE_coat);
  }

 private:
  PrincipledValues values_;
  uint32_t kind_;
  Vec3 f0_;
};

std::unique_ptr<Material> make(const PrincipledValues& values, std::unique_ptr<Material> stand_in_material,
                               uint32_t kind) {
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
  values.specular = table.number("specular");
  values.specular_color = table.color("specular_color");
  values.coat = table.texture("coat");
  values.coat_roughness = table.texture("coat_roughness");
  return make(values, nullptr, shader::MATERIAL_principled);
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

}  // namespace eyeray::materials
