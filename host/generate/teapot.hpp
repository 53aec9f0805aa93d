// "teapot" of Haines' databases: Newell's, of 32 Bézier patches cut into triangles, on a chessboard.
#pragma once

#include "host/generate/classic.hpp"

namespace eyeray::generate {

// 16 control points: rows along s, and in a row along t.
using BezierPatch = std::array<std::array<Vec3, 4>, 4>;

// All 32: rim, body, handle, spout, lid, bottom.
std::vector<BezierPatch> teapot_patches();

// 64 n² − 8 n triangles with normals at their corners. Where patches meet in a point there are none on one
// side.
void teapot_mesh(int size_factor, MeshSink& sink);

// The same surface itself: 32 [[bezier]] in one table.
std::string teapot_bezier();

extern const Classic teapot_classic;

}  // namespace eyeray::generate
