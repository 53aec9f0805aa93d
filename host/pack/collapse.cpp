#include "host/pack/collapse.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::pack {
namespace {

// The cost of a step at a node, and at a leaf.
constexpr float node_cost = 1.0f;
constexpr float leaf_cost = 1.0f;
constexpr float never = std::numeric_limits<float>::infinity();

bool is_leaf(uint32_t refers_to) {
  return refers_to >= LEAF;
}
uint32_t first_slot(uint32_t leaf) {
  return (leaf & ~LEAF) >> 3;
}
uint32_t count(uint32_t leaf) {
  return (leaf & 7u) + 1;
}
uint32_t make_leaf(uint32_t first, uint32_t count) {
  return LEAF | first << 3 | (count - 1);
}

// The best cover of a part of the binary BVH by at most i = 1 … width children of one node.
template <uint32_t width>
struct Cover {
  std::array<float, width + 1> cost{};    // for i children; [0] is unused
  std::array<uint8_t, width + 1> left{};  // how many of i cover the left half; 0: as for i − 1
  uint8_t within = 0;    // as one child that is a node: how many of its children cover the left half
  uint32_t leaf = NONE;  // the one leaf that holds all of it, where there can be one
  bool whole = false;    // whether that leaf is better than a node
};

template <uint32_t width>
class Collapser {
  static constexpr uint32_t most_in_leaf = std::min(width, 8u);
  static constexpr uint32_t worth_a_task = 4096;

 public:
  Collapser(std::span<const shader::uvec4> nodes, const shader::Bvh& bvh)
      : nodes_(nodes), bvh_(bvh), covers_(nodes.size() / 2) {}

  CollapsedBvh run() {
    find_covers(0, uint32_t(covers_.size()));
    bvh4_nodes_.reserve(nodes_.size() / 2 * width);
    add_node();
    fill(0, bvh_.root);
    const uint32_t size = stack_size();
    return {std::move(bvh4_nodes_), size};
  }

 private:
  float area(const shader::uvec4& child) const {
    std::array<float, 3> size{};
    for (int axis = 0; axis < 3; ++axis)
      size[size_t(axis)] = (float(child[axis] >> 16) - float(child[axis] & 0xffffu)) * bvh_.step[axis];
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }

  shader::uvec4 around(const shader::uvec4& a, const shader::uvec4& b) const {
    shader::uvec4 both(0);
    for (int axis = 0; axis < 3; ++axis)
      both[axis] = std::min(a[axis] & 0xffffu, b[axis] & 0xffffu) | std::max(a[axis] >> 16, b[axis] >> 16)
                                                                        << 16;
    return both;
  }

  Cover<width> cover(const shader::uvec4& child) const {
    if (!is_leaf(child.w)) return covers_[child.w];
    Cover<width> leaf;
    leaf.leaf = count(child.w) <= most_in_leaf ? child.w : NONE;
    leaf.whole = leaf.leaf != NONE;
    leaf.cost.fill(area(child) * leaf_cost * (leaf.whole ? 1.0f : 2.0f));
    return leaf;
  }

  Cover<width> cover_node(uint32_t node) const {
    const shader::uvec4& a = nodes_[2 * node];
    const shader::uvec4& b = nodes_[2 * node + 1];
    const Cover<width> left = cover(a);
    const Cover<width> right = cover(b);
    Cover<width> both;
    std::array<float, width + 1> split{};
    std::array<uint8_t, width + 1> to_left{};
    for (uint32_t i = 2; i <= width; ++i) {
      split[i] = never;
      for (uint32_t j = 1; j < i; ++j) {
        const float cost = left.cost[j] + right.cost[i - j];
        if (cost >= split[i]) continue;
        split[i] = cost;
        to_left[i] = uint8_t(j);
      }
    }
    const float size = area(around(a, b));
    if (left.leaf != NONE && right.leaf != NONE) both.leaf = joined(left.leaf, right.leaf);
    const float as_node = size * node_cost + split[width];
    const float as_leaf = both.leaf == NONE ? never : size * leaf_cost;
    both.whole = as_leaf <= as_node;
    both.within = to_left[width];
    both.cost[1] = std::min(as_leaf, as_node);
    for (uint32_t i = 2; i <= width; ++i) {
      const bool better = split[i] < both.cost[i - 1];
      both.cost[i] = better ? split[i] : both.cost[i - 1];
      both.left[i] = better ? to_left[i] : uint8_t(0);
    }
    return both;
  }

  // One leaf for both, if their slots adjoin and are few enough; else NONE.
  static uint32_t joined(uint32_t a, uint32_t b) {
    if (first_slot(a) > first_slot(b)) std::swap(a, b);
    const uint32_t together = count(a) + count(b);
    return first_slot(a) + count(a) == first_slot(b) && together <= most_in_leaf
               ? make_leaf(first_slot(a), together)
               : NONE;
  }

  // Finds the covers of the nodes `first` … `end` − 1, which are a node and all nodes below it, or none. A
  // node precedes its left half, and the left half precedes the right one.
  void find_covers(uint32_t first, uint32_t end) {
    if (end - first <= worth_a_task) {
      for (uint32_t node = end; node-- > first;) covers_[node] = cover_node(node);
      return;
    }
    const uint32_t right = nodes_[2 * first + 1].w;
    const uint32_t middle = is_leaf(right) ? end : right;
    parallel_invoke([&] { find_covers(first + 1, middle); }, [&] { find_covers(middle, end); });
    covers_[first] = cover_node(first);
  }

  uint32_t add_node() {
    bvh4_nodes_.insert(bvh4_nodes_.end(), width, shader::uvec4(0xffffu, 0xffffu, 0xffffu, NONE));
    return uint32_t(bvh4_nodes_.size() / width - 1);
  }

  struct Children {
    std::array<shader::uvec4, width> list;
    uint32_t count = 0;
  };

  // Appends the children that cover `child`, at most `most` of them.
  void gather(const shader::uvec4& child, uint32_t most, Children& children) const {
    if (!is_leaf(child.w)) {
      const Cover<width>& cover = covers_[child.w];
      while (most > 1 && cover.left[most] == 0) --most;
      if (most > 1) {
        gather(nodes_[2 * child.w], cover.left[most], children);
        gather(nodes_[2 * child.w + 1], most - cover.left[most], children);
        return;
      }
    }
    children.list[children.count++] = child;
  }

  // Makes the collapsed node `to` from the binary node `from`.
  void fill(uint32_t to, uint32_t from) {
    Children children;
    gather(nodes_[2 * from], covers_[from].within, children);
    gather(nodes_[2 * from + 1], width - covers_[from].within, children);
    place(to, children);
  }

  void place(uint32_t to, const Children& children) {
    for (uint32_t i = 0; i < children.count; ++i) {
      shader::uvec4 child = children.list[i];
      const Cover<width> all = cover(child);
      child.w = all.whole ? all.leaf : add_node();
      bvh4_nodes_[width * to + i] = child;
    }
    for (uint32_t i = 0; i < children.count; ++i) {
      const uint32_t node = bvh4_nodes_[width * to + i].w;
      const uint32_t from = children.list[i].w;
      if (is_leaf(node)) continue;
      if (is_leaf(from))
        halve(node, children.list[i]);
      else
        fill(node, from);
    }
  }

  // Turns a leaf with too many slots into the node `to` with two leaves.
  void halve(uint32_t to, shader::uvec4 leaf) {
    const uint32_t all = leaf.w;
    leaf.w = make_leaf(first_slot(all), most_in_leaf);
    bvh4_nodes_[width * to] = leaf;
    leaf.w = make_leaf(first_slot(all) + most_in_leaf, count(all) - most_in_leaf);
    bvh4_nodes_[width * to + 1] = leaf;
  }

  // The size in the worst case: of every node the deepest child is visited first, while the others wait.
  uint32_t stack_size() const {
    std::vector<uint32_t> below(bvh4_nodes_.size() / width);
    for (size_t node = below.size(); node-- > 0;) {
      uint32_t children = 0;
      uint32_t deepest = 0;
      for (size_t i = 0; i < width; ++i) {
        const uint32_t child = bvh4_nodes_[width * node + i].w;
        children += child != NONE;
        if (!is_leaf(child)) deepest = std::max(deepest, below[child]);
      }
      below[node] = children - 1 + deepest;
    }
    return below[0];
  }

  std::span<const shader::uvec4> nodes_;
  const shader::Bvh& bvh_;
  RawVector<Cover<width>> covers_;  // one for each binary node
  RawVector<shader::uvec4> bvh4_nodes_;
};

}  // namespace

CollapsedBvh collapse(std::span<const shader::uvec4> nodes, const shader::Bvh& bvh, uint32_t children) {
  CHECK_LT(size_t{1}, nodes.size());
  if (children == 4) return Collapser<4>(nodes, bvh).run();
  if (children == 8) return Collapser<8>(nodes, bvh).run();
  CHECK_EQ(children, uint32_t{16});
  return Collapser<16>(nodes, bvh).run();
}

PacketBvh add_packet_bvh(records::PackedScene& scene, uint32_t lanes) {
  CHECK(scene.has_bvh && scene.quantised_nodes && scene.instances.empty());
  const CollapsedBvh bvh = collapse(scene.nodes, scene.bvhs[0], lanes);
  const PacketBvh added{uint32_t(scene.nodes.size()), bvh.stack_size};
  scene.nodes.insert(scene.nodes.end(), bvh.nodes.begin(), bvh.nodes.end());
  return added;
}

}  // namespace eyeray::engine::pack
