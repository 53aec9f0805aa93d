#pragma once

#include <cstdint>

namespace eyeray::engine {

// Pixels [x, x + width) × [y, y + height); row 0 is an image's top.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  int64_t pixels() const { return int64_t{width} * height; }
  friend bool operator==(const Rect&, const Rect&) = default;
};

}  // namespace eyeray::engine
