#include "host/gpu/raw_buffer.hpp"

#include "host/core/error.hpp"

namespace eyeray::engine::gpu {

RawBuffer::RawBuffer(std::shared_ptr<Context> context, size_t bytes, MemoryKind kind, std::string_view name)
    : context_(std::move(context)) {
  if (context_->emulates) {
    emulated_ = std::make_unique<std::byte[]>(bytes);
    mapped_ = emulated_.get();
    return;
  }
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  if (kind != MemoryKind::host)
    info.usage |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                  VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
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
  memory_ = allocate_memory(*context_, requirements, kind, bytes, fmt::format("buffer '{}'", name));
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
  if (!context_->abandoned && !context_->emulates) destroy();
}

}  // namespace eyeray::engine::gpu
