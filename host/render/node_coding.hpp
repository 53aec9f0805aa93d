// Trees as the shaders' nodes (records.h, Tree).
#pragma once

#include "accel/tree.hpp"
#include "records/packer.hpp"

namespace eyeray {

// Whether the boxes of `tree` stay nearly as tight with 16 bits a plane: where a part matters that is tiny
// against the whole they do not.
bool quantising_is_harmless(const accel::Tree& tree);

// Appends the nodes of `tree`, as scene.quantised_nodes has them, and its Tree record. Tree::order begins at
// `first_slot`; a lone item is an instance, of which the first is `first_instance`.
void add_tree(const accel::Tree& tree, uint32_t first_slot, uint32_t first_instance, PackedScene& scene);

}  // namespace eyeray
