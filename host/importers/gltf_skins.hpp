// Skins of a glTF file: where joints and weights put the vertices as the file's nodes stand. Private to the
// importers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

// The deformation of a mesh by the node that shows it.
struct GltfPose {
  std::span<const Mat4> joints;  // from a vertex to the world, by each joint; empty: it has no skin
  std::vector<double> weights;   // of the morph targets; empty: the mesh's own
};

// The joints' matrices of a skin; `worlds` are those of the file's nodes, as far as they stand in the scene.
// Empty where a joint does not, or there are none.
std::vector<Mat4> joint_matrices(const GltfObject& document, GltfBuffers& buffers, size_t skin,
                                 std::span<const std::optional<Mat4>> worlds);

// Adds the morph targets of a primitive, by their weights, to its vertices.
void add_targets(const GltfObject& primitive, std::span<const double> weights, const GltfObject& document,
                 GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices);

// Adds a breach for each morph target that could not be shown, whatever its weight is now.
void check_targets(const GltfObject& primitive, const GltfObject& document, GltfBuffers& buffers,
                   GltfBreaches& breaches);

// Moves vertices to where their joints hold them, each by the mean of its joints' matrices.
void move_to_joints(const GltfObject& attributes, std::span<const Mat4> joints, const GltfObject& document,
                    GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices);

}  // namespace eyeray::engine::importers
