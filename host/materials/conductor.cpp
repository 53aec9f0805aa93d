#include <algorithm>

#include "host/materials/physical.hpp"
#include "host/materials/registry.hpp"
#include "host/optics/metals.hpp"

namespace eyeray::engine::materials {

extern const MaterialType conductor_type;

namespace {

constexpr std::string_view manual =
    R"(A metal, polished or rough. It is given by a name, by refractive indices, or by a colour.

```toml
[[material]]
name = "ring"
type = "conductor"
metal = "gold"
roughness = 0.25
```

BSDF = F · D · G / (4 cosθᵢ cosθₒ), with GGX microfacets and height-correlated masking. Light that microfacets
scatter onto each other is included, so a rough metal is as bright as it should be. F is the Fresnel
reflectance of the index n + ik. For a `color`, F is Schlick's: from that color at perpendicular incidence to
white at grazing incidence. `whitted` and `raycast` show an approximation: a smoother metal is more like a
mirror.

**Source.** Walter, Marschner, Li, Torrance: Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Heitz: Understanding
the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 3(2), 2014. Kulla, Conty: Revisiting Physically Based Shading at
Imageworks, SIGGRAPH 2017.
)";

constexpr auto metal_names = [] {
  std::array<std::string_view, optics::metals.size()> names;
  for (size_t i = 0; i < names.size(); ++i) names[i] = optics::metals[i].name;
  return names;
}();

constexpr Key keys[] = {
    {.name = "metal",
     .type = KeyType::choice,
     .doc = "Name of the metal. It replaces `n` and `k`, or `color`.",
     .choices = metal_names,
     .optional = true},
    {.name = "n",
     .type = KeyType::color,
     .doc = "Refractive index at red, green and blue; each above 0.",
     .max = 100,
     .optional = true},
    {.name = "k",
     .type = KeyType::color,
     .doc = "Extinction coefficient at red, green and blue.",
     .max = 100,
     .optional = true},
    {.name = "color",
     .type = KeyType::texture,
     .doc = "Reflectance at perpendicular incidence.",
     .max = 1,
     .optional = true},
    roughness_key,
};

class Conductor final : public Physical {
 public:
  Conductor(const ConductorValues& values, const PhongValues& stand_in)
      : Physical(make_phong(stand_in)), values_(values) {}

  Vec3 base_color(const TextureContext& point) const override { return color()->at(point); }

  Bsdf bsdf(const ScatteringContext& context, const Scattering&) const override {
    return {.metal = values_.color
                         ? optics::schlick(values_.color->at(context.point) * context.color, Vec3(1))
                         : values_.index,
            .metallic = 1,
            .roughness = values_.roughness->at(context.point).y};
  }

  void pack(records::Packer& packer) const override {
    const uint32_t packed_color = color()->pack(packer), roughness = values_.roughness->pack(packer);
    shader::Material& record = pack_stand_in(shader::MATERIAL_conductor, packer);
    record.color = packed_color;
    record.roughness = roughness;
    record.a = records::to_vec4(values_.index.mean);
    record.b = records::to_vec4(values_.index.f0, values_.color ? 0 : 1);
    record.c = glm::vec3(values_.index.f90);
    packer.scene.lobes.insert({shader::LOBE_glossy, shader::LOBE_multiple});
    packer.scene.has_conductors |= !values_.color;
  }

 private:
  TexturePtr color() const {
    return values_.color ? values_.color : textures::make_constant(values_.index.at(1));
  }

  ConductorValues values_;
};

std::unique_ptr<Material> parse(TableReader& table) {
  const bool index = table.has("n") || table.has("k");
  if (int(table.has("metal")) + int(index) + int(table.has("color")) != 1)
    table.error("metal", "a conductor must have one of `metal`, `n` and `k`, or `color`");
  if (index && !(table.has("n") && table.has("k"))) table.error("n", "`n` and `k` belong together");
  if (table.has("n") && table.valid("n")) {
    const Vec3 n = table.color("n");
    if (!(std::min({n.x, n.y, n.z}) > 0)) table.error("n", "must be above 0 in each channel");
  }
  if (table.failed()) return nullptr;
  ConductorValues values{.index = {}, .color = nullptr, .roughness = table.texture("roughness")};
  if (table.has("color")) {
    values.color = table.texture("color");
  } else if (index) {
    values.index = optics::conductor(table.color("n"), table.color("k"));
  } else {
    const optics::Metal& metal = optics::metals[size_t(table.choice("metal"))];
    values.index = optics::conductor(metal.n, metal.k);
  }
  return make_conductor(values);
}

}  // namespace

extern const MaterialType conductor_type{.name = "conductor", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Material> make_conductor(const ConductorValues& values) {
  const Vec3 f0 =
      values.color ? values.color->constant().value_or(values.color->at(Vec2(0.5))) : values.index.at(1);
  const double roughness = typical(*values.roughness);
  // The stand-in scatters the light that it does not reflect sharply.
  const double scattered = 1 - (1 - roughness) * (1 - roughness);
  const auto body = textures::make_constant(f0 * scattered);
  return std::make_unique<Conductor>(values, stand_in(body, f0, roughness));
}

}  // namespace eyeray::engine::materials
