// Skins and morph targets of a glTF file, which move vertices by the joints and weights of its nodes. Private
// to the importers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

// The deformation of a mesh by the node that shows it.
struct GltfPose {
  std::span<const Mat4> joints;  // each joint's map from a vertex to the world; empty: the mesh has no skin
  std::vector<double> weights;   // weights of the morph targets; empty: the mesh's own weights
};

// The matrices of a skin's joints. `worlds`: the matrices of those of the file's nodes that are in the scene.
// Empty if a joint is not in the scene, or if the skin has no joints.
std::vector<Mat4> joint_matrices(const GltfObject& document, GltfBuffers& buffers, size_t skin,
                                 std::span<const std::optional<Mat4>> worlds);

// Adds the morph targets of a primitive, by their weights, to its vertices.
void add_targets(const GltfObject& primitive, std::span<const double> weights, const GltfObject& document,
                 GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices);

// Adds a breach for each morph target that could not be shown, whatever its weight is now.
void check_targets(const GltfObject& primitive, const GltfObject& document, GltfBuffers& buffers,
                   GltfBreaches& breaches);

// Moves each vertex by the weighted mean of its joints' matrices.
void move_to_joints(const GltfObject& attributes, std::span<const Mat4> joints, const GltfObject& document,
                    GltfBuffers& buffers, GltfBreaches& breaches, VertexPool& vertices);

}  // namespace eyeray::engine::importers
