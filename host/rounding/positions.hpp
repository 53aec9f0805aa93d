// The displaced positions of a pixel at which the reference is evaluated: float32 may put the camera ray
// there.
#pragma once

#include <cstddef>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::rounding {

// Positions relative to the pixel's own, in pixels. If `rounding`, the size of a rounding error, is above 0,
// the first `angles` positions are on a ring as wide as that. The last positions are `angles` on each of four
// rings. `between`: in the middle come `angles` / 2 positions on each ring between the first ring and the
// four. `surfaces`: the number of surfaces that the pixel's rays hit.
struct Positions {
  std::vector<Vec2> all;
  size_t innermost = 0;  // the number of positions on the ring of a rounding error
};
Positions positions_around(double rounding, double surfaces, int angles, bool between = false);

}  // namespace eyeray::engine::rounding
