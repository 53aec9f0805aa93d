// The strength and the colour of lights in scene files.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"

namespace eyeray::engine::lights {

// A photometric key, and how many of its unit a light of the luminous intensity 1 has (candela; lux for
// suns, cd/m² for area lights). If it cannot be known, 0.
struct PhotometricKey {
  std::string_view key;
  double of_one;
};

// The keys of every light by which its colour is stated: `intensity` and `kelvin`.
std::span<const reading::Key> strength_keys();

// The light's intensity as the renderer takes it: `intensity` times the colour of `kelvin`. If one of `keys`
// is stated, it decides the luminance, and the colour stays. A picture's values are then cd/m², so that
// surfaces under 1 lux of white light, which scatter it all, have the value 1/π. `per_candela`: the
// renderer's intensity of one. Errors go to the table: two of `keys`, and one for a light that is black.
Vec3 read_intensity(reading::TableReader& table, double per_candela,
                    std::initializer_list<PhotometricKey> keys);

}  // namespace eyeray::engine::lights
