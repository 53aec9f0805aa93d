#include "host/gpu/memory.hpp"

#include <optional>

#include "host/core/error.hpp"

namespace eyeray::gpu {
namespace {

// The first memory type among `allowed` that has all `flags`.
std::optional<uint32_t> find_memory(const Context& context, uint32_t allowed, VkMemoryPropertyFlags flags) {
  for (uint32_t i = 0; i < context.memory.memoryTypeCount; ++i)
    if ((allowed & 1u << i) && (context.memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
  return std::nullopt;
}

uint32_t choose_memory(const Context& context, uint32_t allowed, MemoryKind kind, std::string_view what) {
  constexpr VkMemoryPropertyFlags mapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags cached = mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  if (kind == MemoryKind::device) {
    if (auto type = find_memory(context, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)) return *type;
  } else {
    if (auto type = find_memory(context, allowed, cached)) return *type;
    if (auto type = find_memory(context, allowed, mapped)) return *type;  // Vulkan promises this one
  }
  throw Error(ExitCode::no_device, "{} has no memory of the kind that {} needs", context.info.name, what);
}

}  // namespace

VkDeviceMemory allocate_memory(const Context& context, const VkMemoryRequirements& requirements,
                               MemoryKind kind, size_t bytes, std::string_view what) {
  auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = choose_memory(context, requirements.memoryTypeBits, kind, what);
  const uint32_t heap = context.memory.memoryTypes[info.memoryTypeIndex].heapIndex;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult result = vkAllocateMemory(context.device, &info, nullptr, &memory);
  if (result != VK_SUCCESS)
    throw Error(ExitCode::no_device, "{} has no {} bytes left for {} in a heap of {} bytes: {}",
                context.info.name, bytes, what, context.memory.memoryHeaps[heap].size, result_name(result));
  return memory;
}

}  // namespace eyeray::gpu
