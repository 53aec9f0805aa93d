#include <cmath>

#include "host/lights/make.hpp"
#include "host/lights/registry.hpp"
#include "host/lights/strength.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::lights {

extern const LightType point_type;

namespace {

constexpr std::string_view manual =
    R"(A point that emits the same light in all directions.

```toml
[[light]]
type = "point"
position = [2, 5, 3]
intensity = 30
```
)";

constexpr std::string_view falloffs[] = {"inverse_square", "none"};

constexpr Key keys[] = {
    {.name = "position", .type = KeyType::vec3, .doc = "Position of the light."},
    {.name = "falloff",
     .type = KeyType::choice,
     .doc = "`\"inverse_square\"`: the light falls with the square of the distance, and is `intensity` at "
            "distance 1. `\"none\"`: the light is the same at every distance.",
     .fallback = "\"inverse_square\"",
     .choices = falloffs},
    {.name = "candela",
     .type = KeyType::number,
     .doc = "Luminous intensity, in candela.",
     .min = 0,
     .optional = true},
    {.name = "lumens",
     .type = KeyType::number,
     .doc = "Luminous flux in all directions, in lumens: a bulb of 60 W has 800.",
     .min = 0,
     .optional = true},
};

class Point final : public Light {
 public:
  explicit Point(const PointLight& values) : values_(values) { type = point_type.name; }

  Illumination illuminate(const Vec3& point) const override {
    const Vec3 to_light = values_.position - point;
    const double distance = glm::length(to_light);
    return {to_light / distance, falls_off() ? values_.intensity / (distance * distance) : values_.intensity,
            distance};
  }

  void pack(records::Packer& packer) const override {
    packer.add(shader::Light{.intensity = glm::vec3(values_.intensity),
                             .kind = shader::LIGHT_point,
                             .a = records::to_vec4(packer.relative(values_.position), falls_off() ? 1 : 0),
                             .b = shader::vec4(0)});
  }

  LightForm form() const override { return values_; }

 private:
  bool falls_off() const { return values_.falloff == Falloff::inverse_square; }

  PointLight values_;
};

std::unique_ptr<Light> parse(TableReader& table) {
  const PointLight values{table.vec3("position"),
                          read_intensity(table, 1 / M_PI, {{"candela", 1}, {"lumens", 4 * M_PI}}),
                          static_cast<Falloff>(table.choice("falloff"))};
  if (table.failed()) return nullptr;
  return make_light(values);
}

}  // namespace

extern const LightType point_type{.name = "point", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Light> make_light(const PointLight& values) {
  return std::make_unique<Point>(values);
}

}  // namespace eyeray::engine::lights
