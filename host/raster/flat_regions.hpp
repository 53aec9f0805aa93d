// The regions that outlines enclose, as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine::raster {

// Appends triangles to `points` and `triangles` of the area within an odd number of `outlines`, which neither
// cross nor touch each other, all in a plane of space. A convex outline alone becomes a fan, any other slabs
// between its corners. Corners stay as they are.
void add_region(const std::vector<std::vector<Vec3>>& outlines, std::vector<Vec3>& points,
                std::vector<std::array<uint32_t, 3>>& triangles);

}  // namespace eyeray::engine::raster
