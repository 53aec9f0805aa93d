// The features of a device that a user's kernel may declare.
#pragma once

#include <vector>

#include "host/gpu/vulkan.hpp"

namespace eyeray::engine::gpu {

// Numbers of 8, 16 and 64 bits, as far as the device has them. Must outlive the creation of the device.
class KernelFeatures {
 public:
  explicit KernelFeatures(VkPhysicalDevice device);
  KernelFeatures(const KernelFeatures&) = delete;
  KernelFeatures& operator=(const KernelFeatures&) = delete;

  // Adds all of them to those that the device is created with.
  void enable(VkDeviceCreateInfo& info);

 private:
  VkPhysicalDeviceFeatures2 base_;
  VkPhysicalDevice16BitStorageFeatures storage_16_;
  VkPhysicalDevice8BitStorageFeaturesKHR storage_8_;
  VkPhysicalDeviceShaderFloat16Int8FeaturesKHR small_numbers_;
  std::vector<const char*> extensions_;
};

}  // namespace eyeray::engine::gpu
