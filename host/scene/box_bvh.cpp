#include "host/scene/box_bvh.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine {

namespace {

constexpr uint32_t most_in_leaf = 4;
constexpr uint32_t worth_a_thread = 4096;  // a subtree with fewer leaves is built by one thread

Bounds joined(const Bounds& a, const Bounds& b) {
  return {glm::min(a.min, b.min), glm::max(a.max, b.max)};
}

}  // namespace

BoxBvh::BoxBvh(uint32_t count, const std::function<Bounds(uint32_t)>& box, Acceleration acceleration)
    : count_(count) {
  if (acceleration == Acceleration::brute_force || count == 0) return;
  CHECK_LT(count, 1u << 31);

  std::vector<Key> keys(count);
  parallel_for(0, int(count), [&](int i) {
    const Bounds bounds = box(uint32_t(i));
    keys[size_t(i)] = {bounds.min + bounds.max, uint32_t(i)};  // twice the centre: the order is the same
  });
  leaves_ = 1;
  while (count > uint64_t(leaves_) * most_in_leaf) leaves_ *= 2;
  nodes_.resize(2 * size_t(leaves_) - 1);
  boxes_.resize(count);
  build(0, 0, leaves_, keys, box);
}

void BoxBvh::build(size_t node, uint32_t first_leaf, uint32_t leaves, std::vector<Key>& keys,
                   const std::function<Bounds(uint32_t)>& box) {
  const uint32_t begin = first_of(first_leaf);
  const uint32_t end = first_of(first_leaf + leaves);
  if (leaves == 1) {
    for (uint32_t i = begin; i < end; ++i) {
      boxes_[i] = keys[i].box;
      nodes_[node] = joined(nodes_[node], box(keys[i].box));
    }
    return;
  }

  // Halve the keys across the axis along which they spread most.
  Bounds centers;
  for (uint32_t i = begin; i < end; ++i) centers.include(keys[i].center);
  const Vec3 spread = centers.max - centers.min;
  const int axis = spread.x > spread.y && spread.x > spread.z ? 0 : spread.y > spread.z ? 1 : 2;
  const uint32_t half = leaves / 2;
  std::nth_element(keys.begin() + begin, keys.begin() + first_of(first_leaf + half), keys.begin() + end,
                   [&](const Key& a, const Key& b) { return a.center[axis] < b.center[axis]; });

  const auto build_half = [&](int side) {
    build(2 * node + 1 + size_t(side), first_leaf + uint32_t(side) * half, half, keys, box);
  };
  if (leaves >= worth_a_thread) {
    parallel_for(0, 2, build_half);
  } else {
    build_half(0);
    build_half(1);
  }
  nodes_[node] = joined(nodes_[2 * node + 1], nodes_[2 * node + 2]);
}

}  // namespace eyeray::engine
