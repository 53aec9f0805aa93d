#include "host/loader/medium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/materials/medium_keys.hpp"
#include "host/scene/integrator.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

constexpr std::string_view manual =
    R"(The medium fills the space outside all other media. `absorption`, `scattering` and `anisotropy` have the same
meaning as for a [dielectric](#type--dielectric). By default the medium is infinite. All light from infinitely
far away is then lost in it: that of an environment, of a `background` and of directional lights. An extent
lets that light in:

| keys | the medium fills |
| --- | --- |
| `min`, `max` | a box |
| `top` | everything below a height |
| `scale_height`, `base` | all heights; its density falls by a factor 1/e per `scale_height`, and it ends 40 of them above `base` |

`scale_height` may be combined with a box or with `top`. Below a `top`, and in height fog, light that arrives
horizontally or from below is lost.

```toml
[medium]
scattering = 0.04
anisotropy = 0.5
scale_height = 3
```)";

constexpr Key medium_table[] = {
    materials::absorption_key,
    materials::scattering_key,
    materials::anisotropy_key,
    {.name = "min",
     .type = KeyType::vec3,
     .doc =
         "One corner of a box. Together with `max`: the medium fills only the box between these two corners.",
     .optional = true},
    {.name = "max",
     .type = KeyType::vec3,
     .doc = "The corner opposite to `min`, greater than it in each coordinate.",
     .optional = true},
    {.name = "top",
     .type = KeyType::number,
     .doc = "The medium fills only the space below this height, y. It cannot be combined with `max`.",
     .optional = true},
    {.name = "scale_height",
     .type = KeyType::number,
     .doc = "Exponential height fog: at height y, `absorption` and `scattering` are multiplied by "
            "exp(-(y - base) / scale_height).",
     .min = 1e-6,
     .max = 1e9,
     .optional = true},
    {.name = "base",
     .type = KeyType::number,
     .doc = "Height at which that factor is 1; 0 when absent. Allowed only together with `scale_height`.",
     .optional = true},
};

}  // namespace

std::span<const Key> medium_keys() {
  return medium_table;
}

std::string_view medium_manual() {
  return manual;
}

Medium read_medium(reading::TableReader& table, IntegratorType integrator) {
  const Medium medium = materials::read_medium(table, 1);
  if (medium.absorption + medium.scattering == Vec3(0))
    for (const char* key : {"anisotropy", "min", "top", "scale_height"})
      if (table.has(key)) {
        table.warning(key,
                      "[medium] is invisible: it has neither `absorption` nor `scattering`; give it one of "
                      "them, or remove the table");
        break;
      }
  return walks_at_random(integrator) ? medium : Medium{};
}

MediumExtent read_medium_extent(reading::TableReader& table) {
  MediumExtent extent;
  for (const auto& [key, other] : {std::pair("min", "max"), std::pair("max", "min")})
    if (table.has(key) && !table.has(other))
      table.error(key, fmt::format("`{}` needs `{}` beside it: the two corners of a box", key, other));
  if (table.has("min") && table.has("max")) {
    extent.min = table.vec3("min");
    extent.max = table.vec3("max");
    if (!glm::all(glm::lessThan(extent.min, extent.max)))
      table.error("max", "the medium's box has no volume: `max` must be above `min` in each coordinate");
  }
  if (table.has("top")) {
    if (table.has("max"))
      table.error("top", "`top` cannot be used with a box, which ends at the height of its `max`");
    extent.max.y = table.number("top");
  }
  if (table.has("scale_height"))
    extent.scale_height = table.number("scale_height");
  else if (table.has("base"))
    table.error("base",
                "`base` is only for a medium with a `scale_height`, whose density depends on the height");
  if (table.has("base")) extent.base = table.number("base");
  return extent;
}

void warn_of_endless_medium(const Scene& scene, DiagnosticLog& log) {
  const MediumExtent& extent = scene.medium_extent;
  const auto lost = [&](const auto& light) {
    const Illumination arriving = light->illuminate(scene.camera.eye);
    return std::isinf(arriving.distance) && extent.endless_towards(arriving.l);
  };
  const Vec3 extinction = scene.medium.absorption + scene.medium.scattering;
  if (!glm::all(glm::greaterThan(extinction, Vec3(0)))) return;
  const bool any_lost = std::ranges::any_of(scene.lights, lost);
  if (extent.endless() && (any_lost || scene.environment || scene.render.background != Vec3(0)))
    log.warning({},
                "[medium] is unbounded, so light from infinitely far away (an environment, a `background` or "
                "a directional light) is lost in it; bound it with `min` and `max`, `top` or `scale_height`");
  else if (any_lost)
    log.warning({},
                "[medium] is unbounded towards a directional light, whose light is lost in it; `min` and "
                "`max` bound it on all sides");
}

}  // namespace eyeray::engine::loader
