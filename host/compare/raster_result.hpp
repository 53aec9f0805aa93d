// Gate R: the triangles drawn by the device's rasteriser are those that camera rays hit (docs/gates.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

// Why an id or a depth that was traced may differ from the one that was drawn.
enum class RasterCause {
  edge,         // a triangle ends, or another begins, as near to the pixel's centre as corners are rounded
  depth,        // two are equally near to the eye within the precision of depths
  tessellation  // a curved surface is that near to the triangles that stand for it
};
inline constexpr int raster_cause_count = 3;
const char* name(RasterCause cause);

// One executor's first hits against the picture of ids and depths.
struct RasterResult {
  std::string value;                          // the executor
  std::string device;                         // that drew
  uint64_t triangles = 0;                     // as they were drawn: cut to the picture, tessellated
  std::map<std::string, uint64_t> not_drawn;  // primitives, by why: "implicit", "with cutouts", "that blend"
  int64_t pixels = 0;
  int64_t equal = 0;   // the same primitive, as near, where the pixel is
  int64_t hidden = 0;  // something that is not drawn is in front of all that is
  std::array<int64_t, raster_cause_count> explained{};
  int64_t unexplained = 0;
  // The first that is not explained, else the first that is.
  Pixel pixel;
  std::string difference;  // in words
  FirstHit traced;
  int32_t drawn = -1;  // the primitive; −1: none
  double drawn_t = 0;

  int64_t explained_pixels() const;
  bool passes() const { return unexplained == 0 && pixels > 0; }
};

}  // namespace eyeray::engine::compare
