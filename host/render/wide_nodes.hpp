// A binary tree's nodes as nodes of more children: of four for wide.comp.glsl, of as many as a subgroup has
// lanes for packet.comp.glsl.
#pragma once

#include <span>
#include <vector>

#include "records/packer.hpp"

namespace eyeray {

// The children of a node of wide.comp.glsl.
inline constexpr uint32_t wide_children = 4;

struct WideTree {
  std::vector<shader::uvec4> nodes;  // children coded as the binary tree's; those that are not there refer
                                     // to NONE. The root comes first.
  uint32_t stack_size = 0;           // the most that can wait while children are visited in any order
};

// Which binary nodes fall away, and which leaves grow together, is what the surface area heuristic finds
// cheapest; boxes stay as they are. `nodes`: those of `tree`, quantised, without instances. `children`, of a
// node and at most in a leaf: 4, 8 or 16; a leaf has at most 8 even then.
WideTree widen(std::span<const shader::uvec4> nodes, const shader::Tree& tree,
               uint32_t children = wide_children);

// Where the tree of packet.comp.glsl is.
struct PacketTree {
  uint32_t first_node = 0;  // among the scene's nodes: where its root's first child is
  uint32_t stack_size = 1;  // WideTree's
};

// Appends that tree, of as many children a node as a subgroup has `lanes`, to the nodes of a scene that has a
// quantised tree and no instances.
PacketTree add_packet_tree(PackedScene& scene, uint32_t lanes);

}  // namespace eyeray
