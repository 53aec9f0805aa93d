#include "host/core/ray_tree.hpp"

#include <algorithm>

namespace eyeray::engine {

bool RayRecorder::has_room() {
  if (kept_ < most) return ++kept_, true;
  ++tree_.lost;
  return false;
}

void RayRecorder::ray(RayKind kind, uint32_t number, uint32_t depth) {
  if (!has_room()) return;
  // The number of rays that lead to this one. If it skips a depth, as in a user's integrator, its parent is
  // the last ray.
  const size_t before = std::min(size_t(depth) + (kind == RayKind::shadow), last_of_depth_.size());
  const size_t parent = before == 0 ? 0 : last_of_depth_[before - 1];
  current_ = tree_.rays.size();
  tree_.rays.push_back({kind, number, parent, tree_.rays[parent].values.size()});
  if (kind == RayKind::shadow) return;
  last_of_depth_.resize(before);
  last_of_depth_.push_back(current_);
}

void RayRecorder::back(uint32_t depth) {
  current_ = depth < last_of_depth_.size() ? last_of_depth_[depth] : 0;
}

void RayRecorder::value(ProbedValue value) {
  if (!has_room()) return;
  // Turn −0 into 0, as in pictures: the sign of a zero is the compiler's choice.
  for (double& number : value.numbers) number += 0.0;
  tree_.rays[current_].values.push_back(std::move(value));
}

}  // namespace eyeray::engine
