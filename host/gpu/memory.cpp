#include "host/gpu/memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <optional>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::gpu {
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
    if (auto type = find_memory(context, allowed, mapped)) return *type;  // Vulkan guarantees such a type
  }
  throw Error(ExitCode::no_device, "{} has no memory of the kind that {} needs", context.info.name, what);
}

// Bytes for the driver's own use: the descriptors of a kernel take some kilobytes.
constexpr VkDeviceSize drivers_share = 1 << 20;

// True if the memory, which can be mapped, has pages up to its end. Linux before 5.14 cannot report this; the
// result is then true.
bool is_backed(VkDevice device, VkDeviceMemory memory, VkDeviceSize bytes) {
  void* address = nullptr;
  if (vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &address) != VK_SUCCESS) return true;
  const auto page = uintptr_t(::sysconf(_SC_PAGESIZE));
  const uintptr_t last = (reinterpret_cast<uintptr_t>(address) + bytes - 1) / page * page;
  const bool backed =
      ::madvise(reinterpret_cast<void*>(last), page, MADV_POPULATE_WRITE) == 0 || errno != EFAULT;
  vkUnmapMemory(device, memory);
  return backed;
}

}  // namespace

void require_room_in_files(const Context& context, VkDeviceSize bytes) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const std::optional<uint32_t> type = find_memory(context, ~0u, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
  if (!type) return;
  auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = bytes + drivers_share;
  info.memoryTypeIndex = *type;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  if (vkAllocateMemory(context.device, &info, nullptr, &memory) != VK_SUCCESS) return;
  // Even after it is freed, this memory stays a part of the driver's file.
  const bool backed = is_backed(context.device, memory, info.allocationSize);
  vkFreeMemory(context.device, memory, nullptr);
  if (!backed)
    throw Error(ExitCode::file_io,
                "{} keeps its memory in a file, but files may have at most {} bytes: File too large; allow "
                "larger files (ulimit -f), or use {}",
                context.info.name, limit.rlim_cur, option_text("backend", "twin"));
}

VkDeviceMemory allocate_memory(const Context& context, const VkMemoryRequirements& requirements,
                               MemoryKind kind, size_t bytes, std::string_view what) {
  require_room_in_files(context, requirements.size);
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

}  // namespace eyeray::engine::gpu
