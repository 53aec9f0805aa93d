// Functions shared by samplers that divide a pixel into n × n cells.
#pragma once

#include <cmath>

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

// The position in the pixel of the point `in_cell` of cell `index`. `samples`: the number of cells, a square
// number.
inline Vec2 in_grid(int samples, uint32_t index, const Vec2& in_cell) {
  const auto n = uint32_t(std::lround(std::sqrt(samples)));
  return (Vec2(index % n, index / n) + in_cell) / double(n);
}

}  // namespace eyeray::engine::reference
