// Access to Vulkan, for the .cpp files of this layer only: volk's run-time entry points, and checks that
// report results by name.
#pragma once

#include <volk.h>

#include <string>
#include <string_view>

#include "host/core/error.hpp"

namespace eyeray::engine::gpu {

// "VK_ERROR_DEVICE_LOST", or "VkResult N" for a result this table does not know.
std::string result_name(VkResult result);

// The Error (no_device) that an attempt to do `what` failed with `result`.
Error failure(VkResult result, std::string_view what);

// The Error (timed_out) that drivers took longer than `seconds` to load, or to open a device.
Error late_start(double seconds);

// Throws `failure(result, what)`, unless the result is VK_SUCCESS.
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

}  // namespace eyeray::engine::gpu
