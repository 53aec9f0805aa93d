#pragma once

#include "host/core/rect.hpp"

namespace eyeray {

// Every stride-th pixel of every stride-th row of an area, from its top left on; with a stride of 1 all of
// it.
struct Grid {
  Rect area;
  int stride;

  Grid(const Rect& area_, int stride_ = 1) : area(area_), stride(stride_) {}

  int width() const { return (area.width + stride - 1) / stride; }
  int height() const { return (area.height + stride - 1) / stride; }
  int64_t pixels() const { return int64_t{width()} * height(); }
};

}  // namespace eyeray
