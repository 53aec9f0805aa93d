#include "host/materials/highlight.hpp"
#include "host/materials/make.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

namespace {

constexpr std::string_view manual =
    R"(An opaque surface that scatters light evenly (`diffuse`), shows a highlight of each light (`specular`), and
reflects its surroundings by the share `reflectance`.

```toml
[[material]]
name = "floor"
type = "phong"
diffuse = { checker = { even = [0.8, 0.3, 0.15], odd = [0.9, 0.85, 0.05], size = 1 } }
specular = 0.3
shininess = 50
```

colour = emission + ambient · (the scene's ambient light) + Σ light · (diffuse · n·l + specular · lobe) +
reflectance · (light from the mirror direction). The sum is over the lights that are visible from the point
and in front of its surface. These are the classic units, without a factor π: a white surface perpendicular to
a light of intensity 1 shows 1. `lobe` is max(0, r·v)^shininess, with r the mirrored direction of the light
(`highlight = "phong"`). Or it is max(0, n·h)^shininess, with h halfway between light and viewer (`"blinn"`).

**Source.** Phong: Illumination for Computer Generated Pictures, CACM 18(6), 1975. Blinn: Models of Light Reflection, SIGGRAPH
1977. Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980.
)";

constexpr Key keys[] = {
    {.name = "diffuse",
     .type = KeyType::texture,
     .doc = "Share of light that is scattered evenly.",
     .fallback = "0.8"},
    {.name = "ambient",
     .type = KeyType::texture,
     .doc = "Share of the scene's ambient light that is reflected. When absent, the same as `diffuse`.",
     .optional = true},
    {.name = "reflectance",
     .type = KeyType::texture,
     .doc = "Share of the light from the mirror direction that is reflected.",
     .fallback = "0",
     .max = 1},
    {.name = "emission",
     .type = KeyType::texture,
     .doc = "Light that the surface emits, whatever shines on it. It illuminates other surfaces only under "
            "`path`.",
     .fallback = "0"},
    specular_key,
    shininess_key,
    highlight_key,
};

class Phong final : public Material {
 public:
  explicit Phong(const PhongValues& values) : values_(values) {}

  Scattering scattering(const ScatteringContext& context) const override {
    Scattering scattering;
    scattering.ambient = ambient()->at(context.point) * context.color;
    scattering.diffuse = values_.diffuse->at(context.point) * context.color;
    scattering.emitted = values_.emission->at(context.point) * context.color;
    scattering.reflected = values_.reflectance->at(context.point);
    values_.highlight.apply(context.point, scattering);
    return scattering;
  }

  Vec3 base_color(const TextureContext& point) const override {
    return values_.diffuse->at(point) + values_.emission->at(point);
  }

  bool emits() const override { return constant_emission() != Vec3(0); }
  std::optional<Vec3> constant_emission() const override { return values_.emission->constant(); }

  void pack(records::Packer& packer) const override {
    auto record = make_record(shader::MATERIAL_phong, values_.highlight, shadow_transmittance(), packer);
    record.base = record.color = values_.diffuse->pack(packer);
    record.reflected = values_.reflectance->pack(packer);
    record.ambient = ambient()->pack(packer);
    record.emission = values_.emission->pack(packer);
    packer.add(record);
    packer.scene.lobes.insert(shader::LOBE_diffuse);
  }

 private:
  const TexturePtr& ambient() const { return values_.ambient ? values_.ambient : values_.diffuse; }

  PhongValues values_;
};

std::unique_ptr<Material> parse(TableReader& table) {
  PhongValues values{.diffuse = table.texture("diffuse"),
                     .reflectance = table.texture("reflectance"),
                     .emission = table.texture("emission"),
                     .highlight = read_highlight(table)};
  if (table.has("ambient")) values.ambient = table.texture("ambient");
  if (table.failed()) return nullptr;
  return make_phong(values);
}

}  // namespace

extern const MaterialType phong_type{.name = "phong", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Material> make_phong(const PhongValues& values) {
  return std::make_unique<Phong>(values);
}

}  // namespace eyeray::engine::materials
