// Reads the primitives of a glTF file that Draco has compressed. Private to the importers.
// Source: Khronos Group: KHR_draco_mesh_compression.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "host/importers/gltf_buffers.hpp"

namespace draco {
class Mesh;
}

namespace eyeray::engine::importers {

class GltfDraco {
 public:
  GltfDraco(const GltfObject& document, GltfBuffers& buffers);

  // Decodes the primitive's Draco data, supplies the buffers with the elements of its accessors, and returns
  // the corners of its triangles, three each. Without Draco data, the accessors have the elements of their
  // bufferViews, and nothing is returned. InputError for data that are damaged, or contradict the accessors.
  std::optional<std::vector<uint32_t>> open(const GltfObject& primitive);

 private:
  const draco::Mesh& mesh(const GltfObject& coding);
  void check(const GltfObject& primitive, const draco::Mesh& mesh);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  std::map<size_t, std::shared_ptr<const draco::Mesh>> meshes_;  // by bufferView
  uint64_t values_ = 0;                                          // numbers decoded in all meshes_
};

}  // namespace eyeray::engine::importers
