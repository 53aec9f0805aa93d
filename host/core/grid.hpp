#pragma once

#include "host/core/rect.hpp"

namespace eyeray::engine {

// Every stride-th pixel of every stride-th row of an area, from its top left on.
struct Grid {
  Rect area;
  int stride;

  Grid(const Rect& of, int every = 1) : area(of), stride(every) {}

  int width() const { return (area.width + stride - 1) / stride; }
  int height() const { return (area.height + stride - 1) / stride; }
  int64_t pixels() const { return int64_t{width()} * height(); }
};

}  // namespace eyeray::engine
