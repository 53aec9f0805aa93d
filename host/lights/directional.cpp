#include <limits>

#include "host/lights/make.hpp"
#include "host/lights/registry.hpp"
#include "host/lights/versine.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::lights {

extern const LightType directional_type;

namespace {

constexpr std::string_view manual =
    R"(The sun: light of one direction and strength everywhere.

```toml
[[light]]
type = "directional"
direction = [-1, -2, -1]
intensity = 0.8
```

With an `angle` it is a disk, which a path sees and which gives shadows soft borders: the sun's is 0.53. It
brings as much light as without. `whitted` and `raycast` take it as if it had none.
)";

constexpr Key keys[] = {
    {.name = "direction", .type = KeyType::vec3, .doc = "The way the light travels, of any length but 0."},
    {.name = "angle",
     .type = KeyType::number,
     .doc = "Under which a path sees it, from rim to rim, in degrees.",
     .fallback = "0",
     .min = 0,
     .max = 90},
};

class Directional final : public Light {
 public:
  explicit Directional(const DirectionalLight& values) : values_(values) { type = directional_type.name; }

  Illumination illuminate(const Vec3&) const override {
    return {values_.to_light, values_.intensity, std::numeric_limits<double>::infinity(), values_.angle / 2};
  }

  void pack(records::Packer& packer) const override {
    packer.add(shader::Light{.intensity = glm::vec3(values_.intensity),
                             .kind = shader::LIGHT_directional,
                             .a = records::to_vec4(values_.to_light, versine(values_.angle / 2)),
                             .b = shader::vec4(0)});
  }

  LightForm form() const override { return values_; }

 private:
  DirectionalLight values_;
};

std::unique_ptr<Light> parse(TableReader& table) {
  const Vec3 direction = table.vec3("direction");
  const double length = glm::length(direction);
  if (table.valid("direction") && !(length > 1e-15)) table.error("direction", "`direction` has no length");
  if (table.failed()) return nullptr;
  return make_light(
      DirectionalLight{-direction / length, table.color("intensity"), glm::radians(table.number("angle"))});
}

}  // namespace

extern const LightType directional_type{
    .name = "directional", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Light> make_light(const DirectionalLight& values) {
  return std::make_unique<Directional>(values);
}

}  // namespace eyeray::engine::lights
