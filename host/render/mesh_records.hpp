// Meshes as records.
#pragma once

#include "records/packer.hpp"
#include "scene/affine.hpp"
#include "scene/mesh.hpp"

namespace eyeray {

// The triangles of `mesh` under `map`, with `origin` as the origin: positions are rounded after it was
// subtracted. Their ids count from `first_id`. Appends normals, texture coordinates
// and colours to the vertices.
std::vector<shader::Primitive> mesh_records(const Mesh& mesh, const Affine& map, const Vec3& origin,
                                            int material, uint32_t first_id,
                                            std::vector<shader::uvec4>& vertices);

}  // namespace eyeray
