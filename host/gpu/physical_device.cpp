#include "host/gpu/physical_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace eyeray::engine::gpu {
namespace {

DeviceType device_type(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return DeviceType::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return DeviceType::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return DeviceType::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return DeviceType::cpu;
    default:
      return DeviceType::other;
  }
}

std::string version_text(uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

// Identifies a device and its driver. llvmpipe leaves the width of its vectors out of its own identifier, so
// the subgroup's size is added.
std::string driver_id(const VkPhysicalDeviceProperties& properties, uint32_t subgroup_size) {
  std::string id = fmt::format("{:08x}{:08x}{:08x}{:02x}", properties.vendorID, properties.deviceID,
                               properties.driverVersion, subgroup_size);
  for (const uint8_t byte : properties.pipelineCacheUUID) id += fmt::format("{:02x}", byte);
  return id;
}

// Vulkan 1.1's information about a device, and 1.2's about its driver and floats.
void describe_version_1_1(VkPhysicalDevice device, uint32_t version, DeviceInfo& info) {
  auto floats = make<VkPhysicalDeviceFloatControlsProperties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES);
  auto driver =
      make<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES, &floats);
  auto subgroup =
      make<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES,
                                               version >= VK_API_VERSION_1_2 ? &driver : nullptr);
  auto maintenance = make<VkPhysicalDeviceMaintenance3Properties>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, &subgroup);
  auto all = make<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &maintenance);
  vkGetPhysicalDeviceProperties2(device, &all);
  info.limits.subgroup_size = subgroup.subgroupSize;
  info.limits.allocation = maintenance.maxMemoryAllocationSize;
  if (version < VK_API_VERSION_1_2) return;
  info.driver = driver.driverName;
  if (driver.driverInfo[0] != '\0') info.driver_version = driver.driverInfo;  // SwiftShader's is empty
  info.slow_compiler = driver.driverID == VK_DRIVER_ID_GOOGLE_SWIFTSHADER;
  info.float_modes = {
      .denorm_preserve = floats.shaderDenormPreserveFloat32 == VK_TRUE,
      .round_to_nearest_even = floats.shaderRoundingModeRTEFloat32 == VK_TRUE,
      .signed_zero_inf_nan_preserve = floats.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE};
}

std::vector<VkQueueFamilyProperties> queue_families(VkPhysicalDevice device) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  return families;
}

}  // namespace

DeviceInfo describe(VkPhysicalDevice device, int index) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(device, &properties);
  DeviceInfo info;
  info.index = index;
  info.name = properties.deviceName;
  info.driver = "unknown driver";
  info.driver_version = version_text(properties.driverVersion);
  info.api_version = version_text(properties.apiVersion);
  info.type = device_type(properties.deviceType);

  const VkPhysicalDeviceLimits& limits = properties.limits;
  info.limits.storage_range = limits.maxStorageBufferRange;
  info.limits.texel_range = uint64_t{limits.maxTexelBufferElements} * 16;
  info.limits.uniform_range = limits.maxUniformBufferRange;
  info.limits.offset_alignment =
      std::max({limits.minStorageBufferOffsetAlignment, limits.minTexelBufferOffsetAlignment,
                limits.minUniformBufferOffsetAlignment});
  std::copy_n(limits.maxComputeWorkGroupCount, 3, info.limits.groups.begin());
  std::copy_n(limits.maxComputeWorkGroupSize, 3, info.limits.group_size.begin());
  info.limits.group_invocations = limits.maxComputeWorkGroupInvocations;
  info.limits.shared_memory = limits.maxComputeSharedMemorySize;
  info.limits.push_constants = limits.maxPushConstantsSize;
  info.limits.storage_buffers =
      std::min({limits.maxPerStageDescriptorStorageBuffers, limits.maxDescriptorSetStorageBuffers,
                limits.maxPerStageResources});
  info.limits.texel_buffers = std::min({limits.maxPerStageDescriptorStorageImages,
                                        limits.maxDescriptorSetStorageImages, limits.maxPerStageResources});
  info.limits.uniform_buffers =
      std::min({limits.maxPerStageDescriptorUniformBuffers, limits.maxDescriptorSetUniformBuffers,
                limits.maxPerStageResources});
  info.limits.drawn_size =
      std::min({limits.maxFramebufferWidth, limits.maxFramebufferHeight, limits.maxImageDimension2D,
                limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
  info.limits.subpixel_bits = limits.subPixelPrecisionBits;

  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(device, &memory);
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.limits.heap = std::max<uint64_t>(info.limits.heap, memory.memoryHeaps[i].size);

  // List everything that is missing, not only the first thing.
  if (properties.apiVersion >= VK_API_VERSION_1_1)
    describe_version_1_1(device, properties.apiVersion, info);
  else
    info.why_not = fmt::format("it supports Vulkan {}, but eyeray needs 1.1", info.api_version);
  info.driver_id = driver_id(properties, info.limits.subgroup_size);
  const auto add_reason = [&info](std::string_view reason) {
    info.why_not += fmt::format("{}{}", info.why_not.empty() ? "" : "; ", reason);
  };
  if (!compute_queue_family(device)) add_reason("it has no compute queue");
  info.compiles_only = info.name.starts_with("Null hardware");  // RADV's name, under RADV_FORCE_FAMILY
  if (info.compiles_only) {
    add_reason("it compiles kernels, but runs none");
    info.limits.heap = info.limits.allocation;  // in the processor's memory
  }
  info.usable = info.why_not.empty();
  return info;
}

bool has_kernel_statistics(VkPhysicalDevice device) {
  uint32_t count = 0;
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr) != VK_SUCCESS) return false;
  std::vector<VkExtensionProperties> extensions(count);
  if (vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()) != VK_SUCCESS)
    return false;
  return std::ranges::any_of(extensions, [](const VkExtensionProperties& each) {
    return std::string_view(each.extensionName) == VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
  });
}

std::optional<QueueFamily> compute_queue_family(VkPhysicalDevice device) {
  const std::vector<VkQueueFamilyProperties> families = queue_families(device);
  std::optional<QueueFamily> found;
  for (uint32_t i = 0; i < families.size(); ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
    const bool dedicated = !(families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT);
    if (!found || dedicated) found = QueueFamily{i, families[i].timestampValidBits};
    if (dedicated) break;
  }
  return found;
}

std::optional<QueueFamily> graphics_queue_family(VkPhysicalDevice device) {
  constexpr VkQueueFlags both = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  const std::vector<VkQueueFamilyProperties> families = queue_families(device);
  for (uint32_t i = 0; i < families.size(); ++i)
    if ((families[i].queueFlags & both) == both) return QueueFamily{i, families[i].timestampValidBits};
  return std::nullopt;
}

}  // namespace eyeray::engine::gpu
