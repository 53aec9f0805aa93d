// Trees as the shaders' nodes (records.h, Tree).
#pragma once

#include <span>

#include "accel/tree.hpp"
#include "records/packer.hpp"

namespace eyeray {

// Whether the boxes of `tree` stay nearly as tight with 16 bits a plane: where a part matters that is tiny
// against the whole they do not.
bool quantising_is_harmless(const accel::Tree& tree);

// Appends the nodes of `tree`, as scene.quantised_nodes has them, and its Tree record. A leaf of `kind` that
// starts at i in Tree::order refers to the slot first_slots[kind] + i, one of `instance_kind` to the instance
// item.
void add_tree(const accel::Tree& tree, std::span<const uint32_t> first_slots, uint32_t instance_kind,
              PackedScene& scene);

}  // namespace eyeray
