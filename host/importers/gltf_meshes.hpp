// The meshes of a glTF file. Each is converted once, when a node first shows it, and again for each node that
// deforms it. Private to the importers.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/gltf_draco.hpp"
#include "host/importers/gltf_materials.hpp"
#include "host/importers/gltf_skins.hpp"
#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

class GltfMeshes {
 public:
  // `lines`: true if lines are shown.
  GltfMeshes(const GltfObject& document, GltfBuffers& buffers, const GltfMaterials& materials,
             GltfLeftOut& left_out, GltfBreaches& breaches, const std::string& file, double smooth,
             bool lines);

  // Gives primitives the materials of a variant (KHR_materials_variants), by its number; empty: their own.
  void show_variant(std::optional<size_t> variant) { variant_ = variant; }

  // A primitive of points or lines.
  struct Loose {
    std::vector<Vec3> positions;                      // points, or the ends of lines
    std::vector<Vec3> colors;                         // linear RGB, one a position; or empty
    std::vector<std::array<uint32_t, 2>> lines = {};  // as indices of positions; empty: these are points
    std::vector<Vec3> normals = {};                   // vectors of any length, one a position; or empty
  };
  // A primitive of a mesh: its index in the meshes made here, or −1 and its points or lines, and the index of
  // its material in the file, or −1. `colored`: its vertices have colours.
  struct Part {
    int mesh;
    int material;
    bool colored;
    std::shared_ptr<const Loose> loose = {};
  };
  // The parts of a mesh: as all nodes show it that do not deform it, and as one node deforms it.
  const std::vector<Part>& parts(size_t index);
  std::vector<Part> posed_parts(size_t index, const GltfPose& pose);

  // Hands over all meshes made so far, and adds warnings of their faults.
  std::vector<Mesh> take(std::vector<std::string>& warnings);

 private:
  std::optional<size_t> material_of(const GltfObject& primitive) const;
  using Made = std::variant<std::monostate, Mesh, Loose>;
  Made read_primitive(const GltfObject& primitive, std::optional<size_t> material, const GltfPose& pose);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  const GltfMaterials& materials_;
  GltfLeftOut& left_out_;
  GltfBreaches& breaches_;
  const std::string& file_;
  double smooth_;  // degrees
  GltfDraco draco_;
  MeshCounts counts_;
  bool lines_;
  std::optional<size_t> variant_;
  std::vector<Mesh> meshes_;
  std::vector<bool> seen_;  // one a mesh of the file: true once it was converted, in any pose
  std::vector<std::optional<std::vector<Part>>> parts_;  // one list a mesh of the file
};

}  // namespace eyeray::engine::importers
