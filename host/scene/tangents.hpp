// Tangents of meshes that bring none.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine {

// Gives Mesh::tangents to each mesh of a material with a normal map that has normals and uv and none yet: at
// a vertex the mean of its triangles' ∂p/∂u, of the uv that the map reads, in the plane square to the normal,
// weighed by their angles there, as Mikkelsen has it ("Simulation of Wrinkled Surfaces Revisited", 2008).
// Where pictures meet that are mirrored, vertices are split.
void make_tangents(Scene& scene);

}  // namespace eyeray::engine
