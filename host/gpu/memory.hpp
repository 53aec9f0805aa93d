// Memory for buffers and images; for the .cpp files of this layer.
#pragma once

#include <cstddef>
#include <string_view>

#include "host/gpu/context.hpp"

namespace eyeray::gpu {

enum class MemoryKind {
  device,  // the device's own; may not be mapped
  shared,  // the device's own and mapped: processor and device have the same memory
  host,    // mapped, for copying to and from; cached where there is such memory
};

// As much as `requirements` say, for `what` of `bytes` bytes ("buffer 'nodes'"), which are for errors. Error
// (no_device) with the numbers when it cannot be had. The caller frees it.
VkDeviceMemory allocate_memory(const Context& context, const VkMemoryRequirements& requirements,
                               MemoryKind kind, size_t bytes, std::string_view what);

}  // namespace eyeray::gpu
