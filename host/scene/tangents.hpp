// Tangents of meshes that bring none.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine {

// Gives Mesh::tangents to each mesh of a material with a normal map that has normals and uv and none
// yet. At a vertex this is the mean of its triangles' ∂p/∂u, of the uv that the map reads, in the
// plane perpendicular to the normal. They are weighted by their angles there, as Mikkelsen has it
// ("Simulation of Wrinkled Surfaces Revisited", 2008). Vertices are split where mirrored parts of a
// picture join.
void make_tangents(Scene& scene);

}  // namespace eyeray::engine
