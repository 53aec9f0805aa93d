#pragma once

namespace eyeray {

// Empties a vector or a string and gives its memory back, which `all = {}` would keep.
template <typename Container>
void free_memory(Container& all) {
  Container().swap(all);
}

}  // namespace eyeray
