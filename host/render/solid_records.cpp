#include "render/solid_records.hpp"

namespace eyeray {

void finish_solid(shader::Primitive& solid, PackedScene& packed) {
  const shader::uvec4 head = packed.vertices[solid.head.w];
  const uint32_t first = solid.head.w + 1 + head.x;
  constexpr uint32_t leaf_words = 6;
  const uint32_t leaves = head.z;
  uint32_t densest = 0, least = SHADOW_OPAQUE;
  for (uint32_t i = 0; i < leaves; ++i) {
    shader::Primitive leaf{};
    leaf.head = packed.vertices[first + leaf_words * i];
    const uint32_t density = packed.materials[material_of(leaf)].head.w;
    packed.vertices[first + leaf_words * i].z = density;
    packed.leaf_uses.emplace(kind_of(leaf), material_of(leaf));
    if (i == 0 || density > densest) solid.head.y = material_of(leaf) | kind_of(solid) << 24;
    densest = std::max(densest, density);
    least = std::min(least, density);
  }
  packed.solid_leaves += leaves;
  packed.mixed_solids = packed.mixed_solids || least < densest;
}

}  // namespace eyeray
