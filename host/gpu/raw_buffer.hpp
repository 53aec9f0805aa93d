// A VkBuffer with its own memory; for the .cpp files of this layer.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "host/gpu/context.hpp"
#include "host/gpu/memory.hpp"

namespace eyeray::engine::gpu {

class RawBuffer {
 public:
  // `name` is for errors. Error (no_device) with the numbers when the memory cannot be had.
  RawBuffer(std::shared_ptr<Context> context, size_t bytes, MemoryKind kind, std::string_view name);
  ~RawBuffer();
  RawBuffer(const RawBuffer&) = delete;
  RawBuffer& operator=(const RawBuffer&) = delete;

  VkBuffer handle() const { return buffer_; }
  std::byte* mapped() const { return mapped_; }  // null for MemoryKind::device

 private:
  void allocate(MemoryKind kind, size_t bytes, std::string_view name);
  void destroy();

  std::shared_ptr<Context> context_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  std::byte* mapped_ = nullptr;
  std::unique_ptr<std::byte[]> emulated_;  // the bytes, on the emulator
};

}  // namespace eyeray::engine::gpu
