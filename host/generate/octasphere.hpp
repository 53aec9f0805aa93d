#pragma once

#include "host/scene/mesh.hpp"

namespace eyeray::engine::generate {

// The unit sphere as an octahedron whose edges are divided into `divisions` ≥ 1 and whose vertices are pushed
// out: 8 · divisions² triangles, 4 · divisions² + 2 vertices, each its own normal.
Mesh octasphere(int divisions);

}  // namespace eyeray::engine::generate
