// Refractive indices of metals.
#pragma once

#include <array>
#include <string_view>

#include "host/core/vec.hpp"

namespace eyeray::optics {

struct Metal {
  std::string_view name;
  Vec3 n, k;  // at 611, 549 and 464 nm
};

inline constexpr std::array metals{
    Metal{"silver", {0.128, 0.125, 0.140}, {3.82, 3.33, 2.61}},
    Metal{"aluminium", {1.255, 0.955, 0.658}, {7.38, 6.68, 5.65}},
    Metal{"gold", {0.204, 0.355, 1.379}, {3.04, 2.70, 1.83}},
    Metal{"copper", {0.317, 0.965, 1.157}, {3.11, 2.58, 2.45}},
    Metal{"brass", {0.452, 0.529, 0.954}, {3.36, 2.76, 1.92}},
};

}  // namespace eyeray::optics
