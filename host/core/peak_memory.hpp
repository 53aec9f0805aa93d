#pragma once

#include <cstdint>

namespace eyeray::engine {

// The most memory that this process has held at a time, in bytes; 0 where the system does not report it. If
// another program started this one, the other's memory does not count, as it does in getrusage's figure.
uint64_t peak_memory();

}  // namespace eyeray::engine
