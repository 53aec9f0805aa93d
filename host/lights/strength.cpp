#include "host/lights/strength.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/optics/temperature.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::lights {

using reading::Key, reading::KeyType;

std::span<const Key> strength_keys() {
  static constexpr Key keys[] = {
      {.name = "intensity",
       .type = KeyType::color,
       .doc = "Light that arrives at a surface; for a point light, at distance 1; for an area light, its "
              "radiance. Beside `lumens`, `candela`, `lux` or `nits` only its colour counts.",
       .fallback = "1"},
      {.name = "kelvin",
       .type = KeyType::number,
       .doc = "Colour temperature of the light, in kelvin: 2700 for bulbs, 6500 for daylight. It multiplies "
              "`intensity` by that colour, of the same luminance.",
       .min = optics::coldest,
       .max = optics::hottest,
       .optional = true},
  };
  return keys;
}

Vec3 read_intensity(reading::TableReader& table, double per_candela,
                    std::initializer_list<PhotometricKey> keys) {
  Vec3 color = table.color("intensity");
  if (table.has("kelvin")) color *= optics::shown_black_body(table.number("kelvin"));
  std::string_view stated;
  for (const auto& [key, of_one] : keys) {
    if (!table.has(key) || !table.valid(key)) continue;
    if (!stated.empty()) {
      table.error(key, fmt::format("`{}` and `{}` state the same: keep one", stated, key));
      continue;
    }
    stated = key;
    const double brightness = luminance(color);
    if (!(of_one > 0))
      table.error(
          key, fmt::format(
                   "`{}` needs the area of the light, which is not known of an ellipsoid: give `nits`", key));
    else if (!(brightness > 0))
      table.error(key, fmt::format("`{}` needs a colour: `intensity` is 0", key));
    else
      color *= table.number(key) / of_one * per_candela / brightness;
    if (!(std::max({color.r, color.g, color.b}) <= largest_number))
      table.error(key,
                  fmt::format("`{}` of {:g} makes this light brighter than float32 arithmetic allows ({:g})",
                              key, table.number(key), largest_number));
  }
  return color;
}

}  // namespace eyeray::engine::lights
