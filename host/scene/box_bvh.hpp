// The BVH of float64 code, as simple as possible: for the reference, and for shapes of many parts. It finds
// the boxes that a ray may hit. Every node is halved at the median of its boxes until a few are left. So the
// BVH is a complete tree, and its shape follows from the number of boxes alone.
//
// Rounding loses no hit, for two reasons. First, every box is widened by the same margin for a ray. So a
// point that a primitive's own intersection counts as a hit lies in the primitive's box. Second,
// `BoxRay::entry` is monotone, because each of its steps (subtract, multiply, compare) is, also in
// floating-point arithmetic. So the entry into a box is never beyond the entry into a box within it, bit for
// bit. A hit counts only if the ray enters the primitive's own box, and is never nearer than that entry.
// Hence every search finds it, in any order, if the search skips only boxes entered beyond the nearest hit so
// far.
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

namespace eyeray::engine {

// Bound on the displacement of a point by rounding, relative to the coordinates it is computed from: 64 units
// of 2⁻⁵³. The intersections of triangles and spheres take no more than 20.
inline constexpr double box_rounding = 0x1p-47;

// A ray, prepared for the intersection with boxes.
class BoxRay {
 public:
  // `margin` > 0: the distance by which every face of a box is moved outwards.
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
  // Cuts [entry, exit] to the part between two planes. A ray in one of the planes gives 0 · ∞, a NaN. The
  // comparisons ignore it, so such a ray counts as between the planes.
  static void clip(double to_min, double to_max, double inverse, double& entry, double& exit) {
    const double near = (inverse < 0 ? to_max : to_min) * inverse;
    const double far = (inverse < 0 ? to_min : to_max) * inverse;
    if (near > entry) entry = near;
    if (far < exit) exit = far;
  }

  Vec3 inverse_;
  Vec3 ahead_, behind_;
};

class BoxBvh {
 public:
  BoxBvh() = default;  // without boxes
  // Builds a BVH of the boxes 0 … count − 1, all finite. `box` is called from many threads. Takes O(n log n),
  // on all cores.
  BoxBvh(uint32_t count, const std::function<Bounds(uint32_t)>& box, Acceleration acceleration);

  // Calls visit(i, limit) for each box that the ray may enter at t ≤ limit, nearer boxes first as far as that
  // costs nothing. Under brute force it visits all boxes. Each call returns the new limit; a negative one
  // ends the search.
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
  std::vector<uint32_t> boxes_;  // indices of boxes, leaf by leaf
};

template <typename Visit>
void BoxBvh::search(const BoxRay& ray, double limit, const Visit& visit) const {
  if (nodes_.empty()) {
    for (uint32_t i = 0; i < count_ && limit >= 0; ++i) limit = visit(i, limit);
    return;
  }

  struct Pending {
    size_t node;
    double entry;
  };
  std::array<Pending, 32> stack;  // one node per level
  size_t pending = 0;
  Pending at{0, ray.entry(nodes_[0])};
  for (;;) {
    // A box that is entered exactly at the limit may have a hit with the same t and a lower index.
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

}  // namespace eyeray::engine
