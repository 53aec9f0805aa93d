// A BVH over lights, by which one light is chosen for a point: the more light it may send there, the more
// probable it is. Conty Estevez, Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG
// 2018; here without splitting. Its data are made once, in a fixed order. Shaders and reference each compute
// a node's importance to a point for themselves.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// Bounds of the origins and directions of light: it comes from within the sphere, along normals that are no
// more than `spread` from the axis, and at no more than `reach` from these normals. Angles are in radians; a
// spread of π covers all directions.
struct LightBounds {
  Vec3 center{0};
  double radius = 0;
  Vec3 axis{0, 0, 1};  // unit
  double spread = M_PI;
  double reach = M_PI / 2;
  bool both_sides = false;  // also along the normals' opposites
  double power = 0;         // above 0, so that no light is forgotten
};

struct LightBvh {
  struct Node {
    LightBounds bounds;
    bool leaf;
    uint32_t child;  // the index of the first of two children; for a leaf, of its light
  };
  static constexpr uint32_t no_trail = std::numeric_limits<uint32_t>::max();
  static constexpr int deepest = 24;  // levels

  // Pairs of children, the root's first; empty for fewer than two lights.
  std::vector<Node> nodes;
  // For each light, the way to its leaf: bit k is set if it takes the second child at level k.
  std::vector<uint32_t> trails;
};

// The BVH over those of `lights` whose power is above 0, which are at most 2²³.
LightBvh light_bvh(std::span<const LightBounds> lights);

}  // namespace eyeray::engine
