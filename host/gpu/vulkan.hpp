// The way to Vulkan, for the .cpp files of this layer only: volk's run-time entry points, and results checked
// by name.
#pragma once

#include <volk.h>

#include <string_view>

namespace eyeray::gpu {

// "VK_ERROR_DEVICE_LOST", or "VkResult N" for a result this table does not know.
std::string result_name(VkResult result);

// Error (no_device) that names `what` was tried and the result, unless it is VK_SUCCESS.
void check(VkResult result, std::string_view what);

// A Vulkan structure with its sType set and everything else zero.
template <typename T>
T make(VkStructureType type, const void* next = nullptr) {
  T value{};
  value.sType = type;
  value.pNext = const_cast<void*>(
      next);  // properties are read through a mutable pNext, everything else through a const one
  return value;
}

}  // namespace eyeray::gpu
