// BVHs as the shaders' nodes (records.h, BVH).
#pragma once

#include "host/bvh/bvh.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// True if the boxes of `bvh` stay nearly as tight with 16 bits a plane. They do not if a part of the
// scene matters that is tiny against the whole.
bool quantising_is_harmless(const bvh::Bvh& bvh);

// Appends the nodes of `bvh`, quantised if scene.quantised_nodes, and its BVH record. Bvh::order begins at
// `first_slot`. Lone items are instances; `first_instance` is the item that is the first instance.
void add_bvh(const bvh::Bvh& bvh, uint32_t first_slot, uint32_t first_instance, records::PackedScene& scene);

}  // namespace eyeray::engine::pack
