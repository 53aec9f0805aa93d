#include "host/gpu/raw_buffer.hpp"

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

uint32_t choose_memory(const Context& context, uint32_t allowed, MemoryKind kind) {
  constexpr VkMemoryPropertyFlags mapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags cached = mapped | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  if (kind == MemoryKind::device) {
    if (auto type = find_memory(context, allowed, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)) return *type;
  } else {
    if (auto type = find_memory(context, allowed, cached)) return *type;
    if (auto type = find_memory(context, allowed, mapped)) return *type;  // Vulkan promises this one
  }
  throw Error(ExitCode::no_device, "{} has no memory of the kind that buffers need", context.info.name);
}

}  // namespace

RawBuffer::RawBuffer(std::shared_ptr<Context> context, size_t bytes, MemoryKind kind, std::string_view name)
    : context_(std::move(context)) {
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (kind != MemoryKind::host)
    info.usage |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
  check(vkCreateBuffer(context_->device, &info, nullptr, &buffer_), "create a buffer");
  try {
    allocate(kind, bytes, name);
  } catch (...) {
    destroy();
    throw;
  }
}

void RawBuffer::allocate(MemoryKind kind, size_t bytes, std::string_view name) {
  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(context_->device, buffer_, &requirements);
  auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = choose_memory(*context_, requirements.memoryTypeBits, kind);
  const uint32_t heap = context_->memory.memoryTypes[info.memoryTypeIndex].heapIndex;
  const VkResult result = vkAllocateMemory(context_->device, &info, nullptr, &memory_);
  if (result != VK_SUCCESS)
    throw Error(ExitCode::no_device, "{} has no {} bytes left for buffer '{}' in a heap of {} bytes: {}",
                context_->info.name, bytes, name, context_->memory.memoryHeaps[heap].size,
                result_name(result));
  check(vkBindBufferMemory(context_->device, buffer_, memory_, 0), "bind a buffer's memory");
  if (kind == MemoryKind::device) return;
  void* address = nullptr;
  check(vkMapMemory(context_->device, memory_, 0, VK_WHOLE_SIZE, 0, &address), "map a buffer");
  mapped_ = static_cast<std::byte*>(address);
}

void RawBuffer::destroy() {
  vkDestroyBuffer(context_->device, buffer_, nullptr);
  vkFreeMemory(context_->device, memory_, nullptr);
}

RawBuffer::~RawBuffer() {
  if (!context_->abandoned) destroy();
}

}  // namespace eyeray::gpu
