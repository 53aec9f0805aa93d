#include "host/materials/highlight.hpp"
#include "host/materials/make.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

namespace {

constexpr std::string_view manual =
    R"(A polished metal. It shows `reflectance` times the light from the mirror direction. A point light is too small
to be hit by a mirrored ray, so a highlight represents it.

```toml
[[material]]
name = "steel"
type = "mirror"
reflectance = [0.9, 0.9, 0.85]
specular = 0.5
shininess = 200
```

colour = reflectance · (light from the mirror direction) + Σ light · specular · lobe. `raycast` does not
reflect, and shades the reflectance instead.

**Source.** Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980.
)";

constexpr Key keys[] = {
    {.name = "reflectance",
     .type = KeyType::texture,
     .doc = "Share of the light from the mirror direction that is reflected.",
     .fallback = "0.95",
     .max = 1},
    specular_key,
    shininess_key,
    highlight_key,
};

class Mirror final : public Material {
 public:
  explicit Mirror(const MirrorValues& values) : values_(values) {}

  Scattering scattering(const ScatteringContext& context) const override {
    Scattering scattering;
    scattering.reflected = values_.reflectance->at(context.point);
    values_.highlight.apply(context.point, scattering);
    return scattering;
  }

  Vec3 base_color(const TextureContext& point) const override { return values_.reflectance->at(point); }

  void pack(records::Packer& packer) const override {
    auto record = make_record(shader::MATERIAL_mirror, values_.highlight, shadow_transmittance(), packer);
    record.color = record.reflected = values_.reflectance->pack(packer);
    packer.add(record);
  }

 private:
  MirrorValues values_;
};

std::unique_ptr<Material> parse(TableReader& table) {
  const MirrorValues values{table.texture("reflectance"), read_highlight(table)};
  if (table.failed()) return nullptr;
  return make_mirror(values);
}

}  // namespace

extern const MaterialType mirror_type{.name = "mirror", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Material> make_mirror(const MirrorValues& values) {
  return std::make_unique<Mirror>(values);
}

}  // namespace eyeray::engine::materials
