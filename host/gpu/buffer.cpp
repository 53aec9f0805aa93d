#include "host/gpu/buffer.hpp"

#include <algorithm>
#include <cstring>

#include "host/core/error.hpp"
#include "host/gpu/raw_buffer.hpp"

namespace eyeray::engine::gpu {
namespace {

constexpr size_t least_guard = 256;

// The guard's word at an offset: no float that rendering produces, no index, and different at every word.
uint32_t guard_word(size_t offset) {
  return 0xfeedc0deu ^ uint32_t(offset * 2654435761u);
}

// The bytes rounded up to a multiple of `unit`, and to at least one unit.
size_t rounded_up(size_t bytes, size_t unit) {
  return std::max(unit, (bytes + unit - 1) / unit * unit);
}

void write_guard(std::byte* all, size_t begin, size_t end) {
  for (size_t i = begin; i < end; i += 4) {
    const uint32_t word = guard_word(i);
    std::memcpy(all + i, &word, 4);
  }
}

// The offset of the first overwritten word of [begin, end), or `end`.
size_t find_damage(const std::byte* all, size_t begin, size_t end) {
  for (size_t i = begin; i < end; i += 4) {
    const uint32_t word = guard_word(i);
    if (std::memcmp(all + i, &word, 4) != 0) return i;
  }
  return end;
}

// Makes copied or filled bytes visible to kernels and further copies.
void transfer_then_shaders(VkCommandBuffer commands) {
  record_barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                 VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
}

}  // namespace

Buffer::Buffer(Device& device, size_t bytes, std::string name, BindingKind kind)
    : context_(device.context()),
      name_(std::move(name)),
      kind_(kind),
      bytes_(rounded_up(bytes, kind == BindingKind::texels ? 16 : 4)),
      guard_(std::max<size_t>(least_guard, context_->info.limits.offset_alignment)) {
  const DeviceLimits& limits = context_->info.limits;
  const uint64_t range = kind == BindingKind::texels    ? limits.texel_range
                         : kind == BindingKind::uniform ? limits.uniform_range
                                                        : limits.storage_range;
  if (bytes_ > range)
    throw Error(ExitCode::no_device, "buffer '{}' has {} bytes, but {} lets a shader see {} of one buffer",
                name_, bytes_, context_->info.name, range);
  const size_t total = bytes_ + 2 * guard_;
  if (total > std::min(limits.allocation, limits.heap))
    throw Error(ExitCode::no_device, "buffer '{}' has {} bytes, but {} has memory for {} (heap of {})", name_,
                bytes_, context_->info.name, limits.allocation, limits.heap);
  if (context_->info.compiles_only) return;
  raw_ = std::make_unique<RawBuffer>(
      context_, total, context_->shares_memory ? MemoryKind::shared : MemoryKind::device, name_);
  std::byte* all = staging();
  write_guard(all, 0, guard_);
  std::memset(all + guard_, 0, bytes_);
  write_guard(all, guard_ + bytes_, total);
  copy_to_device(0, total);
}

Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

void Buffer::upload(std::span<const std::byte> bytes, size_t offset) {
  CHECK_LE(bytes.size(), bytes_);
  CHECK_LE(offset, bytes_ - bytes.size());
  CHECK_EQ(offset % 4 + bytes.size() % 4, 0u);
  if (bytes.empty() || !raw_) return;
  std::memcpy(staging() + guard_ + offset, bytes.data(), bytes.size());
  copy_to_device(guard_ + offset, bytes.size());
}

void Buffer::clear(size_t bytes) {
  CHECK_LE(bytes, bytes_);
  if (!raw_) return;
  if (raw_->mapped()) {
    std::memset(raw_->mapped() + guard_, 0, bytes);
    return;
  }
  context_->begin();
  vkCmdFillBuffer(context_->commands, raw_->handle(), guard_, bytes, 0);
  transfer_then_shaders(context_->commands);
  context_->submit_and_wait("clear a buffer");
}

std::span<const std::byte> Buffer::read(size_t bytes) {
  CHECK_LE(bytes, bytes_);
  const std::byte* all = staging();
  copy_from_device(bytes);
  check_guards(all);
  return {all + guard_, bytes};
}

// The mapped bytes, guards included: the buffer itself, or its copy.
std::byte* Buffer::staging() {
  CHECK(!context_->abandoned);
  if (raw_->mapped()) return raw_->mapped();
  if (!staging_)
    staging_ = std::make_unique<RawBuffer>(context_, bytes_ + 2 * guard_, MemoryKind::host, name_);
  return staging_->mapped();
}

void Buffer::copy_to_device(size_t offset, size_t bytes) {
  if (raw_->mapped()) return;
  context_->begin();
  const VkBufferCopy region{offset, offset, bytes};
  vkCmdCopyBuffer(context_->commands, staging_->handle(), raw_->handle(), 1, &region);
  transfer_then_shaders(context_->commands);
  context_->submit_and_wait("copy a buffer to the device");
}

// Copies the first `bytes` of the payload, and both guards, to mapped memory.
void Buffer::copy_from_device(size_t bytes) {
  if (raw_->mapped()) return;
  context_->begin();
  record_barrier(context_->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                 VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
  const size_t end = guard_ + bytes_;
  const VkBufferCopy regions[] = {{0, 0, guard_ + bytes}, {end, end, guard_}};
  vkCmdCopyBuffer(context_->commands, raw_->handle(), staging_->handle(), 2, regions);
  record_barrier(context_->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  context_->submit_and_wait("copy a buffer from the device");
}

void Buffer::check_guards(const std::byte* all) const {
  const size_t end = guard_ + bytes_;
  const size_t before = find_damage(all, 0, guard_);
  const size_t after = find_damage(all, end, end + guard_);
  if (before == guard_ && after == end + guard_) return;
  throw Error(ExitCode::no_device,
              "a shader wrote outside buffer '{}' ({} bytes): the guard {} at byte {} of it is overwritten",
              name_, bytes_, before < guard_ ? "before" : "after",
              before < guard_ ? int64_t(before) - int64_t(guard_) : int64_t(after) - int64_t(guard_));
}

}  // namespace eyeray::engine::gpu
