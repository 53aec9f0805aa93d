// Cuts polygons into triangles. Private to the importers.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::importers {

// Cuts polygons into triangles, one polygon after the other, and reuses its memory.
class Triangulator {
 public:
  // The triangles of the polygon, as indices of its corners, with its winding: n − 2 for n ≥ 3 corners, none
  // for fewer. Concave polygons of at most `most_ear_corners` corners are cut by ears. Larger ones are cut as
  // fans, which is right only if they are convex. Corners that are not finite give triangles that are not
  // finite.
  const std::vector<std::array<uint32_t, 3>>& cut(std::span<const Vec3> corners);

  // Number of polygons that were cut as fans though they are not convex, since they were too large.
  size_t fans() const { return fans_; }

  // Limit, because the time for cutting ears grows with the square of the number of corners.
  static constexpr size_t most_ear_corners = 1000;

 private:
  void cut_ears();
  void clip(uint32_t before, uint32_t ear, uint32_t after);

  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Vec2> flat_;        // the corners in the polygon's plane, counter-clockwise
  std::vector<uint32_t> before_;  // the neighbours of each corner that is left
  std::vector<uint32_t> after_;
  size_t fans_ = 0;
};

}  // namespace eyeray::engine::importers
