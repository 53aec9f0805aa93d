#include <cmath>
#include <limits>

#include "host/lights/make.hpp"
#include "host/lights/registry.hpp"
#include "host/lights/strength.hpp"
#include "host/lights/versine.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::lights {

extern const LightType directional_type;

namespace {

constexpr std::string_view manual =
    R"(The sun: light of one direction and one strength everywhere.

```toml
[[light]]
type = "directional"
direction = [-1, -2, -1]
intensity = 0.8
```

With an `angle` the light is a disk that paths see, and its shadows have soft borders. The sun's angle is
0.53. The angle does not change the amount of light. `whitted` and `raycast` treat the light as if its angle
were 0.
)";

constexpr Key keys[] = {
    {.name = "direction",
     .type = KeyType::vec3,
     .doc = "Direction in which the light travels, of any length but 0."},
    {.name = "angle",
     .type = KeyType::number,
     .doc = "Angle under which a path sees the light, from rim to rim, in degrees.",
     .fallback = "0",
     .min = 0,
     .max = 90},
    {.name = "lux",
     .type = KeyType::number,
     .doc = "Illuminance of a surface that faces the light, in lux: the sun at noon has 100 000.",
     .min = 0,
     .optional = true},
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
  const Vec3 intensity = read_intensity(table, 1 / M_PI, {{"lux", 1}});
  if (table.failed()) return nullptr;
  return make_light(DirectionalLight{-direction / length, intensity, glm::radians(table.number("angle"))});
}

}  // namespace

extern const LightType directional_type{
    .name = "directional", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Light> make_light(const DirectionalLight& values) {
  return std::make_unique<Directional>(values);
}

}  // namespace eyeray::engine::lights
