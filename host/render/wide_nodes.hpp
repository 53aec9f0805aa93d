// A binary tree's nodes as nodes of four children, for wide.comp.glsl.
#pragma once

#include <span>
#include <vector>

#include "records/records.hpp"

namespace eyeray {

// The children of a wide node, and the most primitives in a leaf of its tree.
inline constexpr uint32_t wide_children = 4;

struct WideTree {
  std::vector<shader::uvec4> nodes;  // four children each, coded as the binary tree's; those that are not
                                     // there refer to NONE. The root comes first.
  uint32_t stack_size = 0;           // the most that can wait while a ray visits children in any order
};

// Which binary nodes fall away, and which leaves grow together, is what the surface area heuristic finds
// cheapest; boxes stay as they are. `nodes`: those of `tree`, quantised, without instances.
WideTree widen(std::span<const shader::uvec4> nodes, const shader::Tree& tree);

}  // namespace eyeray
