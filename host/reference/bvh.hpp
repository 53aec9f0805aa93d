// Finds the boxes that a ray may hit: the reference's own BVH, the simplest possible. Every box is halved at
// the median of its contents until a few are left, so that the BVH is complete and its shape follows from the
// number of boxes alone.
//
// That nothing is lost to rounding rests on two facts. A ray sees every box wider by the same margin, so that
// a point that a primitive's own intersection counts as a hit lies in its box. And `BoxRay::entry` is
// monotone: each of its steps (subtract, multiply, compare) is, in floating-point arithmetic too, so that the
// entry into a box is never beyond that into a box within it, bit for bit. Hence a hit that is taken only
// where the ray enters the primitive's own box, and never nearer than there, is found by every search that
// leaves out no more than boxes entered beyond the nearest hit so far, in any order.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "host/core/acceleration.hpp"
#include "host/core/vec.hpp"
#include "host/scene/bounds.hpp"

namespace eyeray::engine::reference {

// Bound on the displacement of a point by rounding, relative to the coordinates it is computed from: 64 units
// of 2⁻⁵³. The intersections of triangles and spheres take no more than 20.
inline constexpr double rounding = 0x1p-47;

// A ray as boxes see it.
class BoxRay {
 public:
  // `margin` > 0: how much farther out every face of a box lies.
  BoxRay(const Ray& ray, double margin)
      : inverse_(1.0 / ray.d), ahead_(ray.o + margin), behind_(ray.o - margin) {}

  // The t ≥ 0 at which the ray enters the box; infinity where it does not.
  double entry(const Bounds& box) const {
    double entry = 0;
    double exit = std::numeric_limits<double>::infinity();
    clip(box.min.x - ahead_.x, box.max.x - behind_.x, inverse_.x, entry, exit);
    clip(box.min.y - ahead_.y, box.max.y - behind_.y, inverse_.y, entry, exit);
    clip(box.min.z - ahead_.z, box.max.z - behind_.z, inverse_.z, entry, exit);
    return entry <= exit ? entry : std::numeric_limits<double>::infinity();
  }

 private:
  // Cuts [entry, exit] to the part between two planes. A ray along one of them (0 · ∞) is between them: the
  // comparisons leave a NaN out.
  static void clip(double to_min, double to_max, double inverse, double& entry, double& exit) {
    const double near = (inverse < 0 ? to_max : to_min) * inverse;
    const double far = (inverse < 0 ? to_min : to_max) * inverse;
    if (near > entry) entry = near;
    if (far < exit) exit = far;
  }

  Vec3 inverse_;
  Vec3 ahead_, behind_;
};

class Bvh {
 public:
  Bvh() = default;  // of no boxes
  // Builds a BVH of the boxes 0 … count − 1, all finite. `box` is called from many threads. Takes O(n log n),
  // on all cores.
  Bvh(uint32_t count, const std::function<Bounds(uint32_t)>& box, Acceleration acceleration);

  // Calls visit(i, limit) for the boxes that the ray may enter at t ≤ limit, the nearer ones first as far as
  // that costs nothing; all of them under brute force. Each call returns the limit from there on; a negative
  // one ends the search.
  template <typename Visit>
  void search(const BoxRay& ray, double limit, const Visit& visit) const;

 private:
  struct Key {  // a box while the BVH is built
    Vec3 center;
    uint32_t box;
  };
  void build(size_t node, uint32_t first_leaf, uint32_t leaves, std::vector<Key>& keys,
             const std::function<Bounds(uint32_t)>& box);
  uint32_t first_of(uint32_t leaf) const { return uint32_t(uint64_t(count_) * leaf / leaves_); }

  uint32_t count_ = 0;
  uint32_t leaves_ = 0;          // a power of two; leaf i has the boxes from first_of(i) to first_of(i + 1)
  std::vector<Bounds> nodes_;    // the children of node i are 2i + 1 and 2i + 2, the leaves come last
  std::vector<uint32_t> boxes_;  // leaf by leaf
};

template <typename Visit>
void Bvh::search(const BoxRay& ray, double limit, const Visit& visit) const {
  if (nodes_.empty()) {
    for (uint32_t i = 0; i < count_ && limit >= 0; ++i) limit = visit(i, limit);
    return;
  }

  struct Pending {
    size_t node;
    double entry;
  };
  std::array<Pending, 32> stack;  // one a level
  size_t pending = 0;
  Pending at{0, ray.entry(nodes_[0])};
  for (;;) {
    // A box that is entered at the limit itself may have an equal hit of a lower index.
    if (at.entry <= limit && at.entry < std::numeric_limits<double>::infinity()) {
      if (at.node + 1 < leaves_) {
        Pending near{2 * at.node + 1, ray.entry(nodes_[2 * at.node + 1])};
        Pending far{2 * at.node + 2, ray.entry(nodes_[2 * at.node + 2])};
        if (far.entry < near.entry) std::swap(near, far);
        stack[pending++] = far;
        at = near;
        continue;
      }
      const auto leaf = uint32_t(at.node + 1 - leaves_);
      for (uint32_t i = first_of(leaf); i < first_of(leaf + 1) && limit >= 0; ++i)
        limit = visit(boxes_[i], limit);
    }
    if (pending == 0 || limit < 0) return;
    at = stack[--pending];
  }
}

}  // namespace eyeray::engine::reference
