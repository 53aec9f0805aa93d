#pragma once

#include <optional>

#include "host/gpu/device.hpp"
#include "host/gpu/vulkan.hpp"

namespace eyeray::engine::gpu {

// A device's identity and abilities, and whether it suffices for eyeray: Vulkan 1.1 and a compute queue.
DeviceInfo describe(VkPhysicalDevice device, int index);

// True if the driver states statistics of its compiled kernels (VK_KHR_pipeline_executable_properties).
bool has_kernel_statistics(VkPhysicalDevice device);

// A queue family that computes, preferably one without graphics. Its timestamps' width is 0 if it has none.
struct QueueFamily {
  uint32_t index = 0;
  uint32_t timestamp_bits = 0;
};
std::optional<QueueFamily> compute_queue_family(VkPhysicalDevice device);
// A queue family that draws and computes. Vulkan guarantees one if the device draws at all.
std::optional<QueueFamily> graphics_queue_family(VkPhysicalDevice device);

}  // namespace eyeray::engine::gpu
