// Memory for buffers and images; for the .cpp files of this layer.
#pragma once

#include <cstddef>
#include <string_view>

#include "host/gpu/context.hpp"

namespace eyeray::engine::gpu {

enum class MemoryKind {
  device,  // the device's own; may not be mapped
  shared,  // the device's own and mapped: processor and device have the same memory
  host,    // mapped, for copying to and from; cached where there is such memory
};

// Allocates memory that satisfies `requirements`. `what` ("buffer 'nodes'") and `bytes` are for errors. Error
// (no_device) with the numbers when there is no such memory, (file_io) as in require_room_in_files. The
// caller frees the memory.
VkDeviceMemory allocate_memory(const Context& context, const VkMemoryRequirements& requirements,
                               MemoryKind kind, size_t bytes, std::string_view what);

// Error (file_io) when a limit on the size of files (RLIMIT_FSIZE) leaves no room for `bytes` more and some
// for the driver's own use. The driver llvmpipe keeps all memory in one file since Mesa 24, and does not
// notice when that file cannot grow. The first access to such memory would end the process by SIGBUS.
void require_room_in_files(const Context& context, VkDeviceSize bytes);

}  // namespace eyeray::engine::gpu
