// The meshes of a glTF file, each converted once, when a node first shows it, or for each node that bends it.
// Private to the importers.
#pragma once

#include <optional>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/gltf_draco.hpp"
#include "host/importers/gltf_materials.hpp"
#include "host/importers/gltf_skins.hpp"
#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

class GltfMeshes {
 public:
  GltfMeshes(const GltfObject& document, GltfBuffers& buffers, const GltfMaterials& materials,
             GltfLeftOut& left_out, GltfBreaches& breaches, const std::string& file, double smooth);

  // A primitive of a mesh: an index of all our meshes, and of the file's materials, or −1.
  struct Part {
    int mesh;
    int material;
  };
  // The parts of a mesh, as shown everywhere or as deformed by one node.
  const std::vector<Part>& parts(size_t index);
  std::vector<Part> posed_parts(size_t index, const GltfPose& pose);

  // All meshes so far, with warnings of their faults.
  std::vector<Mesh> take(std::vector<std::string>& warnings);

 private:
  std::optional<Mesh> read_primitive(const GltfObject& primitive, std::optional<size_t> material,
                                     const GltfPose& pose);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  const GltfMaterials& materials_;
  GltfLeftOut& left_out_;
  GltfBreaches& breaches_;
  const std::string& file_;
  double smooth_;  // degrees
  GltfDraco draco_;
  MeshCounts counts_;
  std::vector<Mesh> meshes_;
  std::vector<bool> seen_;                               // of each mesh of the file: in any pose
  std::vector<std::optional<std::vector<Part>>> parts_;  // of each mesh of the file
};

}  // namespace eyeray::engine::importers
