#pragma once

#include <array>

#include "host/core/vec.hpp"
#include "host/raster/tessellation.hpp"

namespace eyeray::engine::raster {

// A bicubic Bézier patch, given by rows of four control points, as a grid of triangles with corners on the
// patch. The bound on their distance follows from the patch's second derivatives (Filip, Magedson and Markot:
// Surface algorithms using bounds on derivatives, Computer Aided Geometric Design 3, 1986).
Tessellation tessellate_patch(const std::array<Vec3, 16>& net, double tolerance);

}  // namespace eyeray::engine::raster
