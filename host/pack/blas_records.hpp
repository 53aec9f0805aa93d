// The records of all objects in one space, world space or an object space: shapes, then the triangles of
// meshes.
#pragma once

#include <span>
#include <vector>

#include "host/bvh/box.hpp"
#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/pack/mesh_records.hpp"

namespace eyeray::engine::pack {

class BlasRecords {
 public:
  // The pieces of a shape. box(i) returns the box of the i-th; it is called from many threads.
  template <typename BoxOf>
  void add_shapes(std::span<const shader::Primitive> records, const BoxOf& box) {
    CHECK(meshes_.empty());
    const size_t first = boxes.size();
    shapes_.insert(shapes_.end(), records.begin(), records.end());
    boxes.resize(first + records.size());
    parallel_for(0, int(records.size()), [&](int i) { boxes[first + size_t(i)] = box(size_t(i)); });
  }
  void add_shape(const shader::Primitive& record, const bvh::Box& box);
  // The triangles follow those of the meshes before.
  void add_mesh(const MeshRecords& mesh);

  // Items by number: shapes as they were added, then triangles.
  uint32_t size() const {
    return meshes_.empty() ? uint32_t(shapes_.size()) : meshes_.back().first + meshes_.back().records.size();
  }
  uint32_t kind(uint32_t item) const {
    return item < shapes_.size() ? kind_of(shapes_[item]) : uint32_t{shader::KIND_triangle};
  }
  shader::Primitive record(uint32_t item) const;

  // The boxes of the items and of everything else in the space's BVH. Items without bounds are in no BVH.
  RawVector<bvh::Box> boxes;

 private:
  struct Triangles {
    uint32_t first;  // item
    MeshRecords records;
  };
  std::vector<shader::Primitive> shapes_;
  std::vector<Triangles> meshes_;
};

}  // namespace eyeray::engine::pack
