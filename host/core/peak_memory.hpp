#pragma once

#include <cstdint>

namespace eyeray::engine {

// The most memory that this process has held at a time, in bytes; 0 where the system does not report it. For
// a program that was started by another it counts its own alone, which getrusage's does not.
uint64_t peak_memory();

}  // namespace eyeray::engine
