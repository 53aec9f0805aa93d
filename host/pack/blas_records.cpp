#include "host/pack/blas_records.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::pack {

void BlasRecords::add_shape(const shader::Primitive& record, const bvh::Box& box) {
  CHECK(meshes_.empty());
  shapes_.push_back(record);
  boxes.push_back(box);
}

void BlasRecords::add_mesh(const MeshRecords& mesh) {
  const size_t first = boxes.size();
  meshes_.push_back({uint32_t(first), mesh});
  boxes.resize(first + mesh.size());
  parallel_for(0, int(mesh.size()), [&](int i) { boxes[first + size_t(i)] = mesh.box(uint32_t(i)); });
}

shader::Primitive BlasRecords::record(uint32_t item) const {
  if (item < shapes_.size()) return shapes_[item];
  const auto after = std::upper_bound(meshes_.begin(), meshes_.end(), item,
                                      [](uint32_t i, const Triangles& mesh) { return i < mesh.first; });
  const Triangles& mesh = *std::prev(after);
  return mesh.records.record(item - mesh.first);
}

}  // namespace eyeray::engine::pack
