#include "host/bvh/history.hpp"

#include <algorithm>

namespace eyeray::engine::bvh {
namespace {

// A refitted BVH is kept while it costs rays no more than this times its cost when it was built.
constexpr double most_growth = 1.2;
// With fewer items, a build takes no time, so BVHs are not refitted.
constexpr size_t least_items = 1024;

bool all_finite(const Bvh& bvh, std::span<const Box> boxes) {
  const auto finite = [&](uint32_t item) { return boxes[item].is_finite(); };
  const auto lone_finite = [&](const Child& child) {
    return child.type != ChildType::lone_item || finite(child.index);
  };
  return std::ranges::all_of(bvh.order, finite) && std::ranges::all_of(bvh.nodes, [&](const Node& node) {
           return std::ranges::all_of(node.children, lone_finite);
         });
}

size_t count_finite(std::span<const Box> boxes) {
  return size_t(std::ranges::count_if(boxes, [](const Box& box) { return box.is_finite(); }));
}

}  // namespace

double sah_cost(const Bvh& bvh) {
  double sum = 0;
  for (const Node& node : bvh.nodes)
    for (const Child& child : node.children)
      sum += child.box.area() * (child.type == ChildType::leaf ? child.count : 1);
  return sum / std::max(bvh.box.area(), 1e-300);
}

void refit(Bvh& bvh, std::span<const Box> boxes) {
  // Each node precedes the nodes below it.
  const auto box_of = [&](const Child& child) {
    if (child.type == ChildType::lone_item) return boxes[child.index];
    Box box;
    if (child.type == ChildType::leaf) {
      for (uint32_t i = 0; i < child.count; ++i) box.include(boxes[bvh.order[child.index + i]]);
    } else {
      for (const Child& below : bvh.nodes[child.index].children) box.include(below.box);
    }
    return box;
  };
  for (size_t i = bvh.nodes.size(); i-- > 0;)
    for (Child& child : bvh.nodes[i].children) child.box = box_of(child);
  bvh.box = {};
  for (const Child& child : bvh.nodes[0].children) bvh.box.include(child.box);
}

Bvh BvhHistory::build(std::span<const Box> boxes, const BvhOptions& options) {
  if (boxes.size() < least_items || options.split) return build_bvh(boxes, options);
  const size_t index = next_++, finite = count_finite(boxes);
  if (index < kept_.size()) {
    Kept& kept = kept_[index];
    if (kept.items == boxes.size() && kept.finite == finite && kept.lone == options.first_lone &&
        all_finite(kept.bvh, boxes)) {
      refit(kept.bvh, boxes);
      if (sah_cost(kept.bvh) <= most_growth * kept.cost) return kept.bvh;
    }
  }
  Bvh built = build_bvh(boxes, options);
  kept_.resize(std::max(kept_.size(), index + 1));
  kept_[index] = {built, sah_cost(built), boxes.size(), finite, options.first_lone};
  return built;
}

}  // namespace eyeray::engine::bvh
