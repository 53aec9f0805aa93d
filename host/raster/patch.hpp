#pragma once

#include <array>

#include "host/core/vec.hpp"
#include "host/raster/tessellation.hpp"

namespace eyeray::engine::raster {

// A bicubic Bézier patch, rows of four control points, as a grid of triangles with corners on it. How far it
// is from them follows from its second derivatives (Filip, Magedson and Markot: Surface algorithms using
// bounds on derivatives, Computer Aided Geometric Design 3, 1986).
Tessellation tessellate_patch(const std::array<Vec3, 16>& net, double tolerance);

}  // namespace eyeray::engine::raster
