// A binary BVH over objects that have boxes, built by Embree (rtcBuildBVH) with the surface area
// heuristic.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>

#include "host/bvh/box.hpp"
#include "host/core/raw_vector.hpp"

namespace eyeray::engine::bvh {

inline constexpr uint32_t most_in_leaf = 4;

enum class ChildType : uint8_t { node, leaf, lone_item };

struct Child {
  Box box;
  uint32_t index = 0;  // that of the node, of the leaf's first entry in Bvh::order, or of the item
  uint8_t count = 0;   // count of a leaf's items, 1 … most_in_leaf
  ChildType type = ChildType::node;
};

struct Node {
  Child children[2];
};

struct Bvh {
  Box box;
  RawVector<Node> nodes;      // depth first: the root first, a node's left half, then its right; never empty
  RawVector<uint32_t> order;  // items as leaves hold them, depth first; with splits, some more than once
  int depth = 0;              // in nodes
};

struct BvhOptions {
  // Items from this number on are lone items: they share no leaf with other items, and are not in Bvh::order.
  uint32_t first_lone = std::numeric_limits<uint32_t>::max();
  // Cuts items at a plane where that makes better boxes (spatial splits). Building is slower; tracing is
  // faster if items are long and thin.
  bool split = false;
  // Returns the two parts of an item's box: below and above `position` on `axis`.
  std::function<std::pair<Box, Box>(uint32_t item, int axis, float position)> cut;
};

// Items are indices of `boxes`. Items without a finite box are left out; at least two items must have one.
// The build is parallel, and yet gives the same BVH every time.
Bvh build_bvh(std::span<const Box> boxes, const BvhOptions& options = {});

}  // namespace eyeray::engine::bvh
