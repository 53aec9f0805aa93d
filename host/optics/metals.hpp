// Refractive indices of metals.
#pragma once

#include <array>
#include <string_view>

#include "host/core/vec.hpp"

namespace eyeray::engine::optics {

struct Metal {
  std::string_view name;
  Vec3 n, k;  // refractive index n + ik that shows the metal's colour in linear Rec. 709 red, green, blue
};

inline constexpr std::array metals{
    Metal{"silver", {0.155, 0.117, 0.138}, {4.828, 3.123, 2.147}},
    Metal{"aluminium", {1.657, 0.880, 0.521}, {9.224, 6.270, 4.837}},
    Metal{"gold", {0.143, 0.375, 1.442}, {3.983, 2.386, 1.603}},
    Metal{"copper", {0.200, 0.924, 1.102}, {3.913, 2.453, 2.142}},
    Metal{"brass", {0.444, 0.527, 1.094}, {3.695, 2.765, 1.829}},
};

}  // namespace eyeray::engine::optics
