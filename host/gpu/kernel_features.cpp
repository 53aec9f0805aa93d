#include "host/gpu/kernel_features.hpp"

#include <algorithm>
#include <string_view>

namespace eyeray::engine::gpu {

KernelFeatures::KernelFeatures(VkPhysicalDevice device)
    : base_(make<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2)),
      storage_16_(make<VkPhysicalDevice16BitStorageFeatures>(
          VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_16BIT_STORAGE_FEATURES)),
      storage_8_(make<VkPhysicalDevice8BitStorageFeaturesKHR>(
          VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_8BIT_STORAGE_FEATURES_KHR)),
      small_numbers_(make<VkPhysicalDeviceShaderFloat16Int8FeaturesKHR>(
          VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES_KHR)) {
  uint32_t count = 0;
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr) != VK_SUCCESS) count = 0;
  std::vector<VkExtensionProperties> known(count);
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, known.data()) != VK_SUCCESS)
    known.clear();
  const auto add = [&](const char* extension, auto& features) {
    const bool has = std::ranges::any_of(known, [&](const VkExtensionProperties& each) {
      return std::string_view(each.extensionName) == extension;
    });
    if (!has) return;
    extensions_.push_back(extension);
    features.pNext = base_.pNext;
    base_.pNext = &features;
  };
  base_.pNext = &storage_16_;
  // Extensions of Vulkan 1.1; 8-bit storage needs one that 1.1 has in its core.
  add(VK_KHR_8BIT_STORAGE_EXTENSION_NAME, storage_8_);
  add(VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME, small_numbers_);
  vkGetPhysicalDeviceFeatures2(device, &base_);
  // Only numbers and formats of images: other features change how a driver compiles.
  const VkPhysicalDeviceFeatures all = base_.features;
  base_.features = {};
  base_.features.shaderInt16 = all.shaderInt16;
  base_.features.shaderInt64 = all.shaderInt64;
  base_.features.shaderFloat64 = all.shaderFloat64;
  base_.features.shaderStorageImageExtendedFormats = all.shaderStorageImageExtendedFormats;
  base_.features.shaderStorageImageReadWithoutFormat = all.shaderStorageImageReadWithoutFormat;
  base_.features.shaderStorageImageWriteWithoutFormat = all.shaderStorageImageWriteWithoutFormat;
}

void KernelFeatures::enable(VkDeviceCreateInfo& info) {
  extensions_.insert(extensions_.end(), info.ppEnabledExtensionNames,
                     info.ppEnabledExtensionNames + info.enabledExtensionCount);
  info.enabledExtensionCount = uint32_t(extensions_.size());
  info.ppEnabledExtensionNames = extensions_.data();
  storage_16_.pNext = const_cast<void*>(info.pNext);
  info.pNext = &base_;
}

}  // namespace eyeray::engine::gpu
