// Computes the tangents of meshes that have none.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine {

// Gives Mesh::tangents to each mesh that has normals and uv but no tangents, and a material with a normal
// map. A vertex's tangent is the mean of ∂p/∂u of its triangles, by the uv that the map reads, in the plane
// perpendicular to the normal. Triangles are weighted by their angles at the vertex (Mikkelsen: "Simulation
// of Wrinkled Surfaces Revisited", 2008). Vertices are split where mirrored parts of a picture join.
void make_tangents(Scene& scene);

}  // namespace eyeray::engine
