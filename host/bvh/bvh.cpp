#include "host/bvh/bvh.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "host/bvh/embree_version.hpp"
#include "host/core/error.hpp"
#include "host/core/free_memory.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::bvh {
namespace {

// The costs of testing a node's two boxes, and of testing an item, relative to each other.
constexpr float node_cost = 1.0f;
constexpr float item_cost = 1.0f;
// At this depth Embree makes leaves of all remaining items; ours may go a little deeper.
constexpr unsigned deepest = 56;

// Embree calculates with the bits of an item's number as if they were a fourth coordinate. Plain
// numbers would be denormals, which double the time of a build. So numbers are written as floats from 1 on.
constexpr uint32_t number_zero = 0x3f800000;
uint32_t number_of(const RTCBuildPrimitive& item) {
  return item.primID - number_zero;
}

// A node of the BVH that Embree builds by our callbacks. It counts the nodes and the entries in Bvh::order
// that it and all nodes below it become.
struct BuildNode {
  bool leaf;
  uint32_t nodes;
  uint32_t items;
};
struct BuildInner : BuildNode {
  BuildNode* child[2];
  Box bounds[2];
};
struct BuildLeaf : BuildNode {
  uint32_t count;
  uint32_t all[most_in_leaf];  // sorted, so that lone items are last
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

// Callbacks of Embree. `user`: the BvhOptions.
void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
  auto* node = static_cast<BuildInner*>(rtcThreadLocalAlloc(allocator, sizeof(BuildInner), 16));
  node->leaf = false;
  return node;
}

void set_child_bounds(void* node, const RTCBounds** bounds, unsigned, void*) {
  for (int i = 0; i < 2; ++i) static_cast<BuildInner*>(node)->bounds[i] = to_box(*bounds[i]);
}

// Called when the children are complete.
void set_children(void* node, void** children, unsigned, void*) {
  auto* inner = static_cast<BuildInner*>(node);
  inner->nodes = 1;
  inner->items = 0;
  for (int i = 0; i < 2; ++i) {
    inner->child[i] = static_cast<BuildNode*>(children[i]);
    inner->nodes += inner->child[i]->nodes;
    inner->items += inner->child[i]->items;
  }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* items, size_t count,
                  void* user) {
  auto* leaf = static_cast<BuildLeaf*>(rtcThreadLocalAlloc(allocator, sizeof(BuildLeaf), 16));
  leaf->leaf = true;
  leaf->count = uint32_t(count);
  for (size_t i = 0; i < count; ++i) leaf->all[i] = number_of(items[i]);
  std::sort(leaf->all, leaf->all + count);

  // Separate nodes split lone items from the others.
  const uint32_t first_lone = static_cast<const BvhOptions*>(user)->first_lone;
  leaf->items = uint32_t(std::lower_bound(leaf->all, leaf->all + count, first_lone) - leaf->all);
  leaf->nodes = leaf->count - leaf->items - (leaf->items == 0 ? 1 : 0);
  return leaf;
}

void split_item(const RTCBuildPrimitive* item, unsigned axis, float position, RTCBounds* below,
                RTCBounds* above, void* user) {
  const Box box{{item->lower_x, item->lower_y, item->lower_z}, {item->upper_x, item->upper_y, item->upper_z}};
  Box low = box;
  Box high = box;
  low.upper[int(axis)] = position;
  high.lower[int(axis)] = position;
  // Avoid slices as thin as a few roundings: Embree may put such a slice on the unexpected side. An assertion
  // fails if the expected side is then empty (RenderKit/embree#489; Debian's 3.13 has the fault).
  const float start = box.lower[int(axis)], end = box.upper[int(axis)];
  const float thin = 0x1p-20f * std::max(std::fabs(start), std::fabs(end));
  if (position - start <= thin) {
    low = Box();
    high = box;
  } else if (end - position <= thin) {
    low = box;
    high = Box();
  } else {
    const auto [cut_low, cut_high] =
        static_cast<const BvhOptions*>(user)->cut(number_of(*item), int(axis), position);
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
using EmbreeBvh = std::unique_ptr<RTCBVHTy, Releaser<rtcReleaseBVH>>;

// Converts Embree's BVH to ours. Since every subtree knows its size, its halves are converted in parallel.
class Flattener {
 public:
  Flattener(std::span<const Box> boxes, const BuildInner* root) : boxes_(boxes) {
    bvh_.nodes.resize(root->nodes);
    bvh_.order.resize(root->items);
    Child whole;
    bvh_.depth = flatten(root, 0, 0, whole);
    bvh_.box.include(root->bounds[0]);
    bvh_.box.include(root->bounds[1]);
  }

  Bvh take() { return std::move(bvh_); }

 private:
  static constexpr uint32_t worth_a_task = 4096;

  // Writes nodes from `node_at` on, and items from `item_at` on. The caller sets the child's box. Returns the
  // depth in nodes.
  int flatten(const BuildNode* node, uint32_t node_at, uint32_t item_at, Child& child) {
    if (node->leaf) {
      const auto* leaf = static_cast<const BuildLeaf*>(node);
      std::copy_n(leaf->all, leaf->items, bvh_.order.begin() + item_at);
      return flatten_leaf({leaf->all, leaf->count}, leaf->items, node_at, item_at, child);
    }
    const auto* inner = static_cast<const BuildInner*>(node);
    const BuildNode* const left = inner->child[0];
    const BuildNode* const right = inner->child[1];
    Node& to = bvh_.nodes[node_at] = Node();
    int depths[2];
    const auto go_left = [&] { depths[0] = flatten(left, node_at + 1, item_at, to.children[0]); };
    const auto go_right = [&] {
      depths[1] = flatten(right, node_at + 1 + left->nodes, item_at + left->items, to.children[1]);
    };
    if (inner->nodes >= worth_a_task) {
      parallel_invoke(go_left, go_right);
    } else {
      go_left();
      go_right();
    }
    for (int i = 0; i < 2; ++i) to.children[i].box = inner->bounds[i];
    child.type = ChildType::node;
    child.index = node_at;
    return 1 + std::max(depths[0], depths[1]);
  }

  // Puts the first `shared` items into one leaf, and makes a node for each other item.
  int flatten_leaf(std::span<const uint32_t> items, uint32_t shared, uint32_t node_at, uint32_t item_at,
                   Child& child) {
    if (items.size() == shared) {
      child.type = ChildType::leaf;
      child.index = item_at;
      child.count = uint8_t(shared);
      return 0;
    }
    if (items.size() == 1) {
      child.type = ChildType::lone_item;
      child.index = items[0];
      return 0;
    }
    Child(&children)[2] = (bvh_.nodes[node_at] = Node()).children;
    const auto last = items.size() - 1;
    const int depth = flatten_leaf(items.first(last), shared, node_at + 1, item_at, children[0]);
    flatten_leaf(items.subspan(last), 0, node_at + 1, item_at, children[1]);
    for (size_t i = 0; i < items.size(); ++i) children[i < last ? 0 : 1].box.include(boxes_[items[i]]);
    child.type = ChildType::node;
    child.index = node_at;
    return 1 + depth;
  }

  std::span<const Box> boxes_;
  Bvh bvh_;
};

// The items that Embree sorts and builds a BVH from.
struct BuildItems {
  RawVector<RTCBuildPrimitive> all;  // the items, and room for those that splits add
  size_t count;
};

BuildItems build_items(std::span<const Box> boxes, bool split) {
  BuildItems items{RawVector<RTCBuildPrimitive>(boxes.size() * (split ? 2 : 1)), boxes.size()};
  std::atomic<bool> unbounded = false;
  parallel_for(0, int(boxes.size()), [&](int i) {
    if (!boxes[size_t(i)].is_finite()) unbounded = true;
    const auto& [lower, upper] = boxes[size_t(i)];
    items.all[size_t(i)] = {lower.x, lower.y, lower.z, 0,
                            upper.x, upper.y, upper.z, number_zero + uint32_t(i)};
  });
  if (!unbounded) return items;
  const auto end =
      std::remove_if(items.all.begin(), items.all.begin() + ptrdiff_t(items.count),
                     [&](const RTCBuildPrimitive& item) { return !boxes[number_of(item)].is_finite(); });
  items.count = size_t(end - items.all.begin());
  return items;
}

}  // namespace

Bvh build_bvh(std::span<const Box> boxes, const BvhOptions& options) {
  BuildItems items = build_items(boxes, options.split);
  CHECK_LT(size_t{1}, items.count);

  const Device device(rtcNewDevice(nullptr));
  if (!device)
    throw Error(ExitCode::no_device, "Embree does not start: error {}", int(rtcGetDeviceError(nullptr)));
  const EmbreeBvh bvh(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = options.split ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxBranchingFactor = 2;
  arguments.maxDepth = deepest;
  arguments.sahBlockSize = 1;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = items.count > most_in_leaf ? most_in_leaf : 1;  // so that the root is no leaf
  arguments.traversalCost = node_cost;
  arguments.intersectionCost = item_cost;
  arguments.bvh = bvh.get();
  arguments.primitives = items.all.data();
  arguments.primitiveCount = items.count;
  arguments.primitiveArrayCapacity = items.all.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_child_bounds;
  arguments.createLeaf = create_leaf;
  arguments.splitPrimitive = options.split ? split_item : nullptr;
  arguments.userPtr = const_cast<BvhOptions*>(&options);
  const auto* root = static_cast<const BuildNode*>(rtcBuildBVH(&arguments));
  if (!root)
    throw Error(ExitCode::no_device, "Embree cannot build a BVH over {} items: error {}", items.count,
                int(rtcGetDeviceError(device.get())));
  CHECK_EQ(root->leaf, false);
  free_memory(items.all);
  return Flattener(boxes, static_cast<const BuildInner*>(root)).take();
}

}  // namespace eyeray::engine::bvh
