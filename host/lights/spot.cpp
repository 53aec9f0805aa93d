#include <algorithm>
#include <cmath>

#include "host/lights/make.hpp"
#include "host/lights/registry.hpp"
#include "host/lights/strength.hpp"
#include "host/lights/versine.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::lights {

extern const LightType spot_type;

namespace {

constexpr std::string_view manual =
    R"(A point that emits light in a cone, as spot lights of glTF do. It has full strength within `inner_angle` of
its axis, and falls off towards `outer_angle`. Let s = (cos θ − cos outer) / (cos inner − cos outer), clamped
to [0, 1]. The light is s² times that of a point light.

```toml
[[light]]
type = "spot"
position = [0, 4, 0]
direction = [0, -1, 0]
inner_angle = 10
outer_angle = 30
intensity = 30
```
)";

constexpr Key keys[] = {
    {.name = "position", .type = KeyType::vec3, .doc = "Position of the light."},
    {.name = "direction",
     .type = KeyType::vec3,
     .doc = "Direction in which the light travels along the cone's axis, of any length but 0."},
    {.name = "inner_angle",
     .type = KeyType::number,
     .doc = "Angle from the axis up to which the light has full strength, in degrees.",
     .fallback = "0",
     .min = 0,
     .max = 90,
     .below_max = true},
    {.name = "outer_angle",
     .type = KeyType::number,
     .doc = "Angle from the axis beyond which there is no light, in degrees. It must be greater than "
            "`inner_angle`.",
     .fallback = "45",
     .min = 0,
     .max = 90,
     .above_min = true},
    {.name = "candela",
     .type = KeyType::number,
     .doc = "Luminous intensity along the axis, in candela.",
     .min = 0,
     .optional = true},
    {.name = "lumens",
     .type = KeyType::number,
     .doc = "Luminous flux of the whole cone, in lumens.",
     .min = 0,
     .optional = true},
};

class Spot final : public Light {
 public:
  explicit Spot(const SpotLight& values) : values_(values) { type = spot_type.name; }

  Illumination illuminate(const Vec3& point) const override {
    const Vec3 to_light = values_.position - point;
    const double distance = glm::length(to_light);
    const double cosine = -glm::dot(to_light, values_.direction) / distance;
    const double inner = std::cos(values_.inner), outer = std::cos(values_.outer);
    const double within = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
    return {to_light / distance, values_.intensity * (within * within / (distance * distance)), distance};
  }

  void pack(records::Packer& packer) const override {
    const double outer = versine(values_.outer);
    packer.add(shader::Light{.intensity = glm::vec3(values_.intensity),
                             .kind = shader::LIGHT_spot,
                             .a = records::to_vec4(packer.relative(values_.position), outer),
                             .b = records::to_vec4(values_.direction, 1 / (outer - versine(values_.inner)))});
  }

  LightForm form() const override { return values_; }

 private:
  SpotLight values_;
};

std::unique_ptr<Light> parse(TableReader& table) {
  const Vec3 direction = table.vec3("direction");
  const double length = glm::length(direction);
  if (table.valid("direction") && !(length > 1e-15)) table.error("direction", "`direction` has no length");
  const double inner = table.number("inner_angle"), outer = table.number("outer_angle");
  // Cosines of closer angles cannot be distinguished.
  if (table.valid("inner_angle") && table.valid("outer_angle") && !(outer - inner >= 0.001))
    table.error(
        table.has("outer_angle") ? "outer_angle" : "inner_angle",
        fmt::format("`outer_angle` must exceed `inner_angle` by at least 0.001; they are {:g} and {:g}",
                    outer, inner));
  if (table.failed()) return nullptr;
  const double lit = std::cos(glm::radians(inner)), dark = std::cos(glm::radians(outer));
  const double lumens = 2 * M_PI * ((1 - lit) + (lit - dark) / 3);  // s² has the mean 1/3 between the two
  const Vec3 intensity = read_intensity(table, 1 / M_PI, {{"candela", 1}, {"lumens", lumens}});
  if (table.failed()) return nullptr;
  return make_light(SpotLight{table.vec3("position"), direction / length, intensity, glm::radians(inner),
                              glm::radians(outer)});
}

}  // namespace

extern const LightType spot_type{.name = "spot", .manual = manual, .keys = keys, .parse = parse};

std::unique_ptr<Light> make_light(const SpotLight& values) {
  return std::make_unique<Spot>(values);
}

}  // namespace eyeray::engine::lights
