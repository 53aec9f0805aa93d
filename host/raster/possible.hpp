// The primitives that the geometry alone allows at the centre of a pixel, for renderers that snap corners to
// a grid, round depths, or draw a tessellation in place of its surface.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "host/raster/view.hpp"

namespace eyeray::engine::raster {

// The precision with which triangles are drawn.
struct Exactness {
  double snap = 0;         // the pixels by which a corner may be moved
  double depth_error = 0;  // the error of a drawn nearness, as a share of the triangle's greatest …
  double depth_floor = 0;  // … above this nearness
  double t = 1e-5;         // the relative error that a hit's t may have, as in gate C
};

// The largest displacement of a drawn triangle near a pixel's centre: in pixels, and in nearness.
Vec2 slack(const ScreenTriangle& triangle, const Vec2& center, const View& view, const Exactness& exactness,
           bool tessellated);
// The distance from a point of the picture to the triangle, in pixels; 0 within it.
double distance(const ScreenTriangle& triangle, const Vec2& point);

// The viewer to whom a primitive is visible. A ray hits a triangle only within its corners. A rasteriser
// continues the triangle's plane a little beyond them, if a snapped corner allows it.
enum class Viewer { ray, rasteriser };

class Possible {
 public:
  // `triangles`: all triangles that may be within their slack of `center`. Without `tessellated`, their
  // bounds count as 0.
  Possible(Viewer viewer, const Vec2& center, std::span<const ScreenTriangle> triangles, const View& view,
           const Exactness& exactness, bool tessellated);

  // True if the primitive may be seen at that nearness.
  bool allows(uint32_t id, double nearness) const;
  // True if it is possible that nothing is seen.
  bool allows_nothing() const { return !covered_; }
  // True if a primitive at that nearness may hide everything that is drawn.
  bool may_hide_all(double nearness) const;
  // True if the centre itself is within one of the primitive's triangles.
  bool is_within(uint32_t id) const;

 private:
  struct Piece {
    uint32_t id;
    double low, high;  // the range of its nearness near the centre
    bool within;       // whether the centre is within it
  };

  std::vector<Piece> pieces_;  // the pieces that may be seen
  bool covered_ = false;       // whether a sheet of triangles without a border near the centre covers it
  double surely_ = -std::numeric_limits<double>::infinity();  // the nearest such sheet is at least this near
  double tolerance_ = 0;
};

}  // namespace eyeray::engine::raster
