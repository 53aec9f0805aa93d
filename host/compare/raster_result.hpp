// Gate R: camera rays hit the triangles that the device's rasteriser draws (docs/gates.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "host/compare/frame.hpp"

namespace eyeray::engine::compare {

// The reasons why a traced id or depth may differ from the drawn one.
enum class RasterCause {
  edge,         // a triangle ends or begins within the corners' rounding error of the pixel's centre
  depth,        // two triangles are equally near to the eye, within the precision of depths
  tessellation  // a curved surface deviates that much from the triangles that stand for it
};
inline constexpr int raster_cause_count = 3;
const char* name(RasterCause cause);

// The comparison of one executor's first hits with the drawn picture of ids and depths.
struct RasterResult {
  std::string value;                          // the executor
  std::string device;                         // the device that drew the triangles
  uint64_t triangles = 0;                     // the triangles drawn, after clipping and tessellation
  std::map<std::string, uint64_t> not_drawn;  // primitives by cause: "implicit", "with cutouts", "that blend"
  int64_t pixels = 0;
  int64_t equal = 0;   // the same primitive at the same depth, with the hit's position at the pixel
  int64_t hidden = 0;  // a primitive that is not drawn lies in front of all that are drawn
  std::array<int64_t, raster_cause_count> explained{};
  int64_t unexplained = 0;
  // The first unexplained pixel, else the first explained one.
  Pixel pixel;
  std::string difference;  // in words
  FirstHit traced;
  int32_t drawn = -1;  // the drawn primitive; −1: none
  double drawn_t = 0;

  int64_t explained_pixels() const;
  bool passes() const { return unexplained == 0 && pixels > 0; }
};

}  // namespace eyeray::engine::compare
