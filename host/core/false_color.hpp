// Pictures of data, for people: what an AOV's .png shows.
#pragma once

#include "core/image.hpp"

namespace eyeray {

enum class FalseColor {
  scalar,     // 1 channel: viridis from the least to the greatest finite value
  depth,      // 1 channel: viridis, near is bright; logarithmic, since depths span decades
  ids,        // 1 channel: a colour of its own for every number ≥ 0
  direction,  // 3 channels: (n + 1) / 2
  position,   // 2 or 3 channels: each from its least to its greatest finite value
};

// A 3-channel picture whose .png shows the colours named above. What has no value (a miss: not finite, an id
// below 0, a direction of length 0) is grey.
Image false_color(const Image& data, FalseColor kind);

}  // namespace eyeray
