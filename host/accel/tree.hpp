// A binary tree of boxes over things that have boxes, built by Embree (rtcBuildBVH) with the surface area
// heuristic.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "accel/box.hpp"

namespace eyeray::accel {

// What a child is: a node, or 1 … most_in_leaf items of one kind.
struct Child {
  Box box;
  bool leaf = false;
  uint32_t index = 0;  // of the node, or of a leaf's first place in Tree::order
  uint32_t count = 0;  // of a leaf's items
};

struct Node {
  Child children[2];
};

struct Tree {
  Box box;
  std::vector<Node> nodes;  // the root first; never empty
  std::vector<uint32_t>
      order;  // items as leaves hold them, by kind, then depth first; with splits, some more than once
  std::vector<uint32_t> kind_ends;  // by kind, where its items end in `order`
  int depth = 0;                    // of nodes
  double cost =
      0;  // expected box and item tests of a ray that meets the root's box, by the surface area heuristic
};

inline constexpr uint32_t most_in_leaf = 8;

struct TreeOptions {
  // The kind whose items get a leaf each, if there is one.
  std::optional<uint32_t> lone_kind = {};
  // Cuts items at a plane where that makes better boxes (spatial splits): slower to build, faster to trace
  // where items are long and thin.
  bool split = false;
  // Of an item's box, what lies below and above `position` on `axis`; without it, the item's box is cut.
  std::function<std::pair<Box, Box>(uint32_t item, int axis, float position)> cut;
};

// `kinds` (a number below `kind_count` an item) keeps items of different kinds in different leaves.
// boxes.size() ≥ 2, all finite. Parallel.
Tree build_tree(std::span<const Box> boxes, std::span<const uint8_t> kinds, uint32_t kind_count,
                const TreeOptions& options);

}  // namespace eyeray::accel
