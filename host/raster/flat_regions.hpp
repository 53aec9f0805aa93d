// The regions that outlines enclose, as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::raster {

// Appends triangles of the area within an odd number of `outlines` to `points` and `triangles`. The outlines
// lie in one plane of space, and neither cross nor touch each other. A single convex outline becomes a fan;
// other outlines become slabs between their corners. Corners keep their positions.
void add_region(const std::vector<std::vector<Vec3>>& outlines, std::vector<Vec3>& points,
                std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace eyeray::engine::raster
