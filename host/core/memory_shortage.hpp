// Handles a shortage of memory where nobody can catch std::bad_alloc: in a driver and its threads.
#pragma once

#include <cstddef>

namespace eyeray::engine {

// True if `bytes` of address space can still be mapped (ulimit -v).
bool address_space_left(size_t bytes);

// From now on an uncaught std::bad_alloc, or a crash with hardly any memory left, leads to a message and exit
// code 3. Other crashes stay as they are. Needs the watch of core/termination.
void report_memory_shortage();

}  // namespace eyeray::engine
