// Shading normals for meshes without normals. Private to the importers.
#pragma once

#include <span>

#include "host/scene/mesh.hpp"

namespace eyeray::engine::importers {

// Gives every corner the mean normal of the faces around it, weighted by their angles there (Thürmer and
// Wüthrich: Computing Vertex Normals from Polygonal Facets, JGT 3(1), 1998). Faces count as one surface if
// they share an edge with an angle below `degrees`. Vertices at the same position count as one, and are split
// where surfaces separate. A normal that would point away from a corner's face becomes that of the face.
// `faces` are the unit normals of the mesh's triangles.
void add_smooth_normals(Mesh& mesh, std::span<const Vec3> faces, double degrees);

}  // namespace eyeray::engine::importers
