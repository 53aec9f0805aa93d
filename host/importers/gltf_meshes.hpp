// The meshes of a glTF file, each converted once, when a node first shows it. Private to the importers.
#pragma once

#include <optional>
#include <vector>

#include "importers/gltf_buffers.hpp"
#include "importers/gltf_materials.hpp"
#include "importers/mesh_builder.hpp"

namespace eyeray {

class GltfMeshes {
 public:
  GltfMeshes(const GltfObject& document, GltfBuffers& buffers, const GltfMaterials& materials,
             GltfWarnings& warnings, const std::string& file, double smooth);

  // A primitive of a mesh: an index of all our meshes, and of the file's materials, or −1.
  struct Part {
    int mesh;
    int material;
  };
  const std::vector<Part>& parts(size_t index);

  // All meshes so far, with warnings of what was wrong in them.
  std::vector<Mesh> take(std::vector<std::string>& warnings);

 private:
  std::optional<Mesh> read_primitive(const GltfObject& primitive, std::optional<size_t> material);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  const GltfMaterials& materials_;
  GltfWarnings& warnings_;
  const std::string& file_;
  double smooth_;  // degrees
  MeshCounts counts_;
  std::vector<Mesh> meshes_;
  std::vector<std::optional<std::vector<Part>>> parts_;  // of each mesh of the file
};

}  // namespace eyeray
