#pragma once

#include <cstdint>

namespace eyeray::engine {

// The most memory that this process has held at a time, in bytes; 0 where the system does not report it. The
// memory of a program that started this one does not count, unlike in getrusage's figure.
uint64_t peak_memory();

}  // namespace eyeray::engine
