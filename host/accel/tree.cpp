#include "accel/tree.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>

#include "core/error.hpp"

namespace eyeray::accel {
namespace {

// How much more a test of an item costs than one of a node's two boxes.
constexpr float node_cost = 1.0f;
constexpr float item_cost = 1.0f;
constexpr uint32_t wanted_in_leaf = 4;
constexpr unsigned deepest =
    56;  // Embree makes leaves of whatever is left there; ours may go a little deeper

struct BuildNode {
  struct Inner {
    BuildNode* child[2];
    RTCBounds bounds[2];
  };

  bool leaf;
  uint32_t count;  // of children or items
  union {
    Inner inner;
    uint32_t items[most_in_leaf];
  };
};

Box to_box(const RTCBounds& b) {
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

void set_bounds(RTCBounds& bounds, const Box& box) {
  bounds.lower_x = box.lower.x;
  bounds.lower_y = box.lower.y;
  bounds.lower_z = box.lower.z;
  bounds.upper_x = box.upper.x;
  bounds.upper_y = box.upper.y;
  bounds.upper_z = box.upper.z;
}

// What Embree calls back with.
void* create_node(RTCThreadLocalAllocator allocator, unsigned children, void*) {
  auto* node = static_cast<BuildNode*>(rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16));
  node->leaf = false;
  node->count = children;
  return node;
}

void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i)
    static_cast<BuildNode*>(node)->inner.child[i] = static_cast<BuildNode*>(children[i]);
}

void set_child_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<BuildNode*>(node)->inner.bounds[i] = *bounds[i];
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* items, size_t count, void*) {
  auto* node = static_cast<BuildNode*>(rtcThreadLocalAlloc(allocator, sizeof(BuildNode), 16));
  node->leaf = true;
  node->count = uint32_t(count);
  for (size_t i = 0; i < count; ++i) node->items[i] = items[i].primID;
  return node;
}

void split_item(const RTCBuildPrimitive* item, unsigned axis, float position, RTCBounds* below,
                RTCBounds* above, void* user) {
  const Box box{{item->lower_x, item->lower_y, item->lower_z}, {item->upper_x, item->upper_y, item->upper_z}};
  Box low = box;
  Box high = box;
  low.upper[int(axis)] = position;
  high.lower[int(axis)] = position;
  if (const auto& cut = static_cast<const TreeOptions*>(user)->cut) {
    const auto [cut_low, cut_high] = cut(item->primID, int(axis), position);
    low = low.intersection(cut_low);
    high = high.intersection(cut_high);
  }
  set_bounds(*below, low);
  set_bounds(*above, high);
}

template <auto release>
struct Releaser {
  template <typename T>
  void operator()(T* p) const {
    release(p);
  }
};
using Device = std::unique_ptr<RTCDeviceTy, Releaser<rtcReleaseDevice>>;
using Bvh = std::unique_ptr<RTCBVHTy, Releaser<rtcReleaseBVH>>;

// Embree's tree as ours: depth first, leaves of one kind.
class Flattener {
 public:
  Flattener(std::span<const Box> boxes, std::span<const uint8_t> kinds, uint32_t kind_count,
            std::optional<uint32_t> lone_kind)
      : boxes_(boxes), kinds_(kinds), lone_kind_(lone_kind), next_(kind_count, 0) {}

  Tree run(const BuildNode* root) {
    count_items(root);
    tree_.kind_ends = next_;
    std::partial_sum(tree_.kind_ends.begin(), tree_.kind_ends.end(), tree_.kind_ends.begin());
    for (size_t kind = next_.size(); kind-- > 0;) next_[kind] = tree_.kind_ends[kind] - next_[kind];
    tree_.order.resize(tree_.kind_ends.back());

    for (const Box& box : boxes_) tree_.box.include(box);
    tree_.nodes.reserve(inner_ + 1);
    flatten(root, 0);
    return std::move(tree_);
  }

 private:
  double weight(const Box& box) const { return tree_.box.area() > 0 ? box.area() / tree_.box.area() : 1.0; }

  void count_items(const BuildNode* node) {
    if (node->leaf) {
      for (uint32_t i = 0; i < node->count; ++i) ++next_[kinds_[node->items[i]]];
    } else {
      ++inner_;
      for (uint32_t i = 0; i < node->count; ++i) count_items(node->inner.child[i]);
    }
  }

  Child flatten(const BuildNode* node, int depth) {
    if (node->leaf) {
      std::array<uint32_t, most_in_leaf> items;
      std::copy_n(node->items, node->count, items.begin());
      const std::span some(items.data(), node->count);
      std::sort(some.begin(), some.end(),
                [&](uint32_t a, uint32_t b) { return std::pair(kinds_[a], a) < std::pair(kinds_[b], b); });
      return make_leaf(some, depth);
    }
    const auto index = add_node(depth);
    Box box;
    for (uint32_t i = 0; i < node->count; ++i) {
      Child child = flatten(node->inner.child[i], depth + 1);
      child.box = to_box(node->inner.bounds[i]);
      box.include(child.box);
      tree_.nodes[index].children[i] = child;
    }
    tree_.cost += weight(box) * double(node_cost);
    return {box, false, index, 0};
  }

  // Items sorted by kind: a leaf, or a node of leaves where kinds meet, where each item is to be alone, and
  // at the root.
  Child make_leaf(std::span<const uint32_t> items, int depth) {
    Box box;
    for (const uint32_t item : items) box.include(boxes_[item]);
    const uint8_t kind = kinds_[items[0]];
    const auto same =
        size_t(std::find_if(items.begin(), items.end(), [&](uint32_t i) { return kinds_[i] != kind; }) -
               items.begin());
    const bool alone = items.size() > 1 && (depth == 0 || kind == lone_kind_);
    if (same < items.size() || alone) {
      const size_t middle = same < items.size() ? same : items.size() / 2;
      const auto index = add_node(depth);
      const Child first = make_leaf(items.first(middle), depth + 1);
      const Child rest = make_leaf(items.subspan(middle), depth + 1);
      tree_.nodes[index] = {{first, rest}};
      tree_.cost += weight(box) * double(node_cost);
      return {box, false, index, 0};
    }
    tree_.cost += weight(box) * double(item_cost) * double(items.size());
    const uint32_t first = next_[kind];
    for (const uint32_t item : items) tree_.order[next_[kind]++] = item;
    return {box, true, first, uint32_t(items.size())};
  }

  uint32_t add_node(int depth) {
    tree_.depth = std::max(tree_.depth, depth + 1);
    tree_.nodes.emplace_back();
    return uint32_t(tree_.nodes.size() - 1);
  }

  std::span<const Box> boxes_;
  std::span<const uint8_t> kinds_;
  std::optional<uint32_t> lone_kind_;
  size_t inner_ = 0;            // nodes of Embree's that are no leaves
  std::vector<uint32_t> next_;  // by kind: first how many items, then where in `order` the next goes
  Tree tree_;
};

}  // namespace

Tree build_tree(std::span<const Box> boxes, std::span<const uint8_t> kinds, uint32_t kind_count,
                const TreeOptions& options) {
  CHECK_LT(size_t{1}, boxes.size());
  CHECK_EQ(boxes.size(), kinds.size());
  std::vector<RTCBuildPrimitive> items(boxes.size() * (options.split ? 2 : 1));
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Box& b = boxes[i];
    items[i] = {b.lower.x, b.lower.y, b.lower.z, 0, b.upper.x, b.upper.y, b.upper.z, uint32_t(i)};
  }

  const Device device(rtcNewDevice(nullptr));
  if (!device)
    throw Error(ExitCode::no_device, "Embree does not start: error {}", int(rtcGetDeviceError(nullptr)));
  const Bvh bvh(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = options.split ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = deepest;
  arguments.sahBlockSize = 1;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = wanted_in_leaf;
  arguments.traversalCost = node_cost;
  arguments.intersectionCost = item_cost;
  arguments.bvh = bvh.get();
  arguments.primitives = items.data();
  arguments.primitiveCount = boxes.size();
  arguments.primitiveArrayCapacity = items.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_child_bounds;
  arguments.createLeaf = create_leaf;
  arguments.splitPrimitive = options.split ? split_item : nullptr;
  arguments.userPtr = const_cast<TreeOptions*>(&options);
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  if (!root)
    throw Error(ExitCode::no_device, "Embree cannot build a tree over {} items: error {}", boxes.size(),
                int(rtcGetDeviceError(device.get())));
  return Flattener(boxes, kinds, kind_count, options.lone_kind).run(root);
}

}  // namespace eyeray::accel
