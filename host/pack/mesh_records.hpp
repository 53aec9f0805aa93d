// The triangles of a mesh as records.
#pragma once

#include "host/bvh/box.hpp"
#include "host/records/packer.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/mesh.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine::pack {

// The box around the record of a triangle.
bvh::Box triangle_box(const shader::Primitive& triangle);

// Makes a record of each triangle of a mesh when it is asked for, so that those of a big mesh need not be
// in memory twice. The mesh must outlive it.
class MeshRecords {
 public:
  // The triangles of `mesh` under `map`, with `origin` as the origin: positions are rounded after it was
  // subtracted. Their ids count from `first_id`; `optical_depth`: how much each weakens a shadow ray.
  // Appends normals, texture coordinates and colours to `vertices`; if `bends`, also the data that bent
  // normals need.
  MeshRecords(const Mesh& mesh, const Affine& map, const Vec3& origin, int material, uint32_t optical_depth,
              uint32_t first_id, bool bends, RawVector<shader::uvec4>& vertices);

  uint32_t size() const { return uint32_t(mesh_->triangles.size()); }
  shader::Primitive record(uint32_t triangle) const;
  // The box of a triangle: triangle_box(record(triangle)).
  bvh::Box box(uint32_t triangle) const;

 private:
  Corners corners(uint32_t triangle) const;

  const Mesh* mesh_;
  Affine map_;
  Vec3 origin_;
  bool mirrored_;
  shader::Primitive first_;      // the fields common to all, and the first triangle's id and corners
  uint32_t corner_records_ = 0;  // vec4s that a triangle has among the vertices
};

}  // namespace eyeray::engine::pack
