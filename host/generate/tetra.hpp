// "tetra" of Haines' databases: a tetrahedron of tetrahedra, Sierpiński's.
#pragma once

#include "host/generate/classic.hpp"

namespace eyeray::generate {

// 4ⁿ triangles; coordinates are dyadic, hence exact in float32 too.
void tetra_mesh(int size_factor, MeshSink& sink);

extern const Classic tetra_classic;

}  // namespace eyeray::generate
