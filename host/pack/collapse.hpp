// Turns the nodes of a binary BVH into nodes with more children. kernels/cooperative/bvh4.comp.glsl has four,
// kernels/cooperative/packet.comp.glsl as many as a subgroup has lanes.
#pragma once

#include <span>

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// The children of a node of kernels/cooperative/bvh4.comp.glsl.
inline constexpr uint32_t bvh4_children = 4;

struct CollapsedBvh {
  RawVector<shader::uvec4> nodes;  // children are coded as in the binary BVH; absent ones refer to NONE.
                                   // The root comes first.
  uint32_t stack_size = 0;         // the most children that can wait, in any order of visits
};

// The surface area heuristic decides which binary nodes are removed, and which leaves are merged. Boxes stay
// as they are. `nodes`: the quantised nodes of `bvh`, without instances. `children`: of a node, 4, 8 or 16; a
// leaf has at most as many slots, and at most 8.
CollapsedBvh collapse(std::span<const shader::uvec4> nodes, const shader::Bvh& bvh,
                      uint32_t children = bvh4_children);

// The position of the BVH of kernels/cooperative/packet.comp.glsl.
struct PacketBvh {
  uint32_t first_node = 0;  // index of its root's first child among the scene's nodes
  uint32_t stack_size = 1;  // CollapsedBvh's
};

// Appends that BVH to the nodes of a scene that has a quantised BVH and no instances. A node has as many
// children as a subgroup has `lanes`.
PacketBvh add_packet_bvh(records::PackedScene& scene, uint32_t lanes);

}  // namespace eyeray::engine::pack
