// BVHs of scenes that come one after the other, the frames of an animation. If items have only moved, a BVH
// is refitted: it keeps its nodes and gets new boxes. This takes a fraction of a build's time.
#pragma once

#include <cstddef>
#include <vector>

#include "host/bvh/bvh.hpp"

namespace eyeray::engine::bvh {

// The surface area heuristic's cost of a ray that hits the root: nodes visited, and items tested.
double sah_cost(const Bvh& bvh);

// Computes the boxes of all nodes anew. The items must be those that `bvh` was built from, without splits.
void refit(Bvh& bvh, std::span<const Box> boxes);

// Keeps the BVHs of the previous scene. Only one thread at a time may use it.
class BvhHistory {
 public:
  // Begins another scene, to which the following calls of build() belong.
  void begin_scene() { next_ = 0; }
  // Returns a BVH as build_bvh does, or the previous scene's BVH in this position, refitted. The latter is
  // returned if it has the same items and, refitted, costs rays little more than when it was built.
  Bvh build(std::span<const Box> boxes, const BvhOptions& options);

 private:
  struct Kept {
    Bvh bvh;
    double cost;    // sah_cost() when it was built
    size_t items;   // the number of boxes
    size_t finite;  // the number of finite boxes
    uint32_t lone;  // BvhOptions::first_lone
  };
  std::vector<Kept> kept_;  // in the order of build() in a scene
  size_t next_ = 0;
};

}  // namespace eyeray::engine::bvh
