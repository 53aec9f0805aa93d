// A binary BVH's nodes as nodes of more children: of four for kernels/cooperative/bvh4.comp.glsl, of as many
// as a subgroup has lanes for kernels/cooperative/packet.comp.glsl.
#pragma once

#include <span>

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// The children of a node of kernels/cooperative/bvh4.comp.glsl.
inline constexpr uint32_t bvh4_children = 4;

struct CollapsedBvh {
  RawVector<shader::uvec4> nodes;  // children coded as the binary BVH's; those that are not there refer
                                   // to NONE. The root comes first.
  uint32_t stack_size = 0;         // the most that can wait while children are visited in any order
};

// The surface area heuristic decides which binary nodes are removed, and which leaves are merged. Boxes stay
// as they are. `nodes`: those of `bvh`, quantised, without instances. `children`, of a node and at most in a
// leaf: 4, 8 or 16; a leaf has at most 8 even then.
CollapsedBvh collapse(std::span<const shader::uvec4> nodes, const shader::Bvh& bvh,
                      uint32_t children = bvh4_children);

// The position of the BVH of kernels/cooperative/packet.comp.glsl.
struct PacketBvh {
  uint32_t first_node = 0;  // among the scene's nodes: where its root's first child is
  uint32_t stack_size = 1;  // CollapsedBvh's
};

// Appends that BVH, of as many children a node as a subgroup has `lanes`, to the nodes of a scene that has a
// quantised BVH and no instances.
PacketBvh add_packet_bvh(records::PackedScene& scene, uint32_t lanes);

}  // namespace eyeray::engine::pack
