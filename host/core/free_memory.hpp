#pragma once

#include <malloc.h>

#include <limits>

namespace eyeray::engine {

// Empties a vector or a string and gives its memory back, which `all = {}` would keep.
template <typename Container>
void free_memory(Container& all) {
  Container().swap(all);
}

// From now on the process keeps the memory that it frees. This saves time where memory is allocated and freed
// again and again, since the system clears each page that it hands out.
inline void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, 64 << 20);
}

}  // namespace eyeray::engine
