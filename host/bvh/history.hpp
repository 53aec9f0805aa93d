// BVHs of scenes that come one after the other, the frames of an animation. Where items have only moved, a
// BVH is refitted: it keeps its nodes, whose boxes are made anew, which takes a fraction of a build.
#pragma once

#include <cstddef>
#include <vector>

#include "host/bvh/bvh.hpp"

namespace eyeray::engine::bvh {

// The surface area heuristic's cost of a ray that hits the root: nodes visited, and items tested.
double sah_cost(const Bvh& bvh);

// Makes the boxes of all nodes anew. Items must be those of its build, which did not split any.
void refit(Bvh& bvh, std::span<const Box> boxes);

// Not for several threads at once.
class BvhHistory {
 public:
  // The BVHs that follow are another scene's.
  void begin_scene() { next_ = 0; }
  // Returns a BVH like build_bvh. Instead, the previous scene's BVH in this position is refitted if it has
  // the same items and then costs rays little more than when it was built.
  Bvh build(std::span<const Box> boxes, const BvhOptions& options);

 private:
  struct Kept {
    Bvh bvh;
    double cost;    // when it was built
    size_t items;   // of all boxes
    size_t finite;  // of them
    uint32_t lone;  // BvhOptions::first_lone
  };
  std::vector<Kept> kept_;  // in the order of build() in a scene
  size_t next_ = 0;
};

}  // namespace eyeray::engine::bvh
