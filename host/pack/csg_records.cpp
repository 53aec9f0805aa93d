#include "host/pack/csg_records.hpp"

namespace eyeray::engine::pack {

void finish_csg(shader::Primitive& csg, records::PackedScene& packed) {
  const shader::uvec4 head = packed.vertices[csg.extra];
  const uint32_t first = csg.extra + 1 + head.x;
  constexpr uint32_t leaf_words = 6;
  const uint32_t leaves = head.z;
  uint32_t deepest = 0, least = OPTICAL_DEPTH_OPAQUE;
  for (uint32_t i = 0; i < leaves; ++i) {
    shader::uvec4& leaf_head = packed.vertices[first + leaf_words * i];
    shader::Primitive leaf = shader::primitive_of(leaf_head, {}, {}, {});
    const uint32_t optical_depth = packed.materials[material_of(leaf)].optical_depth;
    leaf.optical_depth = optical_depth;
    leaf_head = shader::head_of(leaf);
    packed.leaf_uses.emplace(kind_of(leaf), material_of(leaf));
    if (i == 0 || optical_depth > deepest)
      csg.material_and_kind = shader::material_and_kind(material_of(leaf), kind_of(csg));
    deepest = std::max(deepest, optical_depth);
    least = std::min(least, optical_depth);
  }
  packed.mixed_csg = packed.mixed_csg || least < deepest;
}

}  // namespace eyeray::engine::pack
