// The displaced positions of a pixel at which the reference is evaluated: where float32 may put the camera
// ray.
#pragma once

#include <cstddef>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::rounding {

// Positions around a pixel's own, in pixels: `angles` on each of four rings, and before them on one as wide
// as a rounding error, where that is known. `surfaces`: the number that the pixel's rays strike. `between`:
// half as many on each ring between that one and the four as well.
struct Places {
  std::vector<Vec2> all;
  size_t innermost = 0;  // those of a rounding error
};
Places places_around(double rounding, double surfaces, int angles, bool between = false);

}  // namespace eyeray::engine::rounding
