// Judges whether the geometry allows both the hit of a ray and the drawn triangle, at one pixel.
#pragma once

#include <optional>
#include <span>

#include "host/compare/raster_result.hpp"
#include "host/raster/possible.hpp"

namespace eyeray::engine::raster {

// The nearest primitive at a pixel's centre, by rays or by the rasteriser.
struct Seen {
  bool anything = false;
  bool in_list = true;  // whether the primitive is one that is drawn
  uint32_t id = 0;
  double nearness = 0;
};

struct Judgement {
  enum { equal, hidden, explained, unexplained } verdict;
  compare::RasterCause cause = compare::RasterCause::edge;
  bool blames_ray = true;  // for an unexplained pixel: whether the ray is wrong, or else the rasteriser
};

// `triangles`: all triangles that may be within their slack of the centre.
Judgement judge(const Seen& traced, const Seen& drawn, const Vec2& center,
                std::span<const ScreenTriangle> triangles, const View& view, const Exactness& exactness);

}  // namespace eyeray::engine::raster
