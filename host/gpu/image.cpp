#include "host/gpu/image.hpp"

#include <algorithm>
#include <cstring>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"
#include "host/gpu/image_objects.hpp"
#include "host/gpu/memory.hpp"

namespace eyeray::engine::gpu {
namespace {

// An image as Vulkan counts: layers are no axis of the extent.
VkImageCreateInfo create_info(const ImageShape& shape) {
  constexpr VkImageType types[] = {VK_IMAGE_TYPE_1D, VK_IMAGE_TYPE_2D, VK_IMAGE_TYPE_3D};
  const ReflectedImage& image = shape.declared;
  auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = types[image.axes - 1];
  info.format = VkFormat(image.format->vulkan);
  info.extent = {shape.extent[0], image.axes > 1 ? shape.extent[1] : 1, image.axes > 2 ? shape.extent[2] : 1};
  info.mipLevels = 1;
  info.arrayLayers = image.arrayed ? shape.extent[image.axes] : 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
               (image.sampled ? VK_IMAGE_USAGE_SAMPLED_BIT : VK_IMAGE_USAGE_STORAGE_BIT);
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  return info;
}

VkImageViewType view_type(const ReflectedImage& image) {
  constexpr VkImageViewType types[] = {VK_IMAGE_VIEW_TYPE_1D, VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_VIEW_TYPE_3D};
  if (!image.arrayed) return types[image.axes - 1];
  return image.axes == 1 ? VK_IMAGE_VIEW_TYPE_1D_ARRAY : VK_IMAGE_VIEW_TYPE_2D_ARRAY;
}

VkBufferImageCopy all_texels(const VkImageCreateInfo& info) {
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, info.arrayLayers};
  region.imageExtent = info.extent;
  return region;
}

}  // namespace

Image::Image(Device& device, const ImageShape& shape, std::string name)
    : context_(device.context()),
      name_(std::move(name)),
      shape_(shape),
      objects_(std::make_unique<Objects>(context_)) {
  CHECK(shape_.declared.format != nullptr);
  uint64_t bytes = shape_.declared.format->numbers.bytes();
  for (const uint32_t length : shape_.extent) {
    CHECK_LE(1u, length);
    bytes = bytes > UINT64_MAX / length ? UINT64_MAX : bytes * length;
  }
  bytes_ = bytes;
  check_device();
  if (context_->info.compiles_only) return;
  copy_ = std::make_unique<RawBuffer>(context_, bytes_, MemoryKind::host, name_);
  if (!context_->emulates) create();
  upload(std::vector<std::byte>(bytes_));
}

Image::~Image() = default;

void Image::check_device() const {
  const VkImageCreateInfo info = create_info(shape_);
  const DeviceInfo& device = context_->info;
  const char* const kind = shape_.declared.sampled ? "sampled" : "storage";
  VkImageFormatProperties most = {};
  if (vkGetPhysicalDeviceImageFormatProperties(context_->physical, info.format, info.imageType, info.tiling,
                                               info.usage, 0, &most) != VK_SUCCESS)
    throw Error(ExitCode::no_device,
                "image '{}' is a {} image of {}, but {} has none of this format: choose another format, or "
                "another device with {}",
                name_, kind, shape_.declared.format->name, device.name, option_text("device"));
  const VkExtent3D &wanted = info.extent, &limit = most.maxExtent;
  if (wanted.width > limit.width || wanted.height > limit.height || wanted.depth > limit.depth ||
      info.arrayLayers > most.maxArrayLayers)
    throw Error(ExitCode::no_device,
                "image '{}' has {} × {} × {} texels in {} layers, but {} has at most {} × {} × {} in {}",
                name_, wanted.width, wanted.height, wanted.depth, info.arrayLayers, device.name, limit.width,
                limit.height, limit.depth, most.maxArrayLayers);
  const uint64_t room = std::min({device.limits.allocation, device.limits.heap, most.maxResourceSize});
  if (bytes_ > room)
    throw Error(ExitCode::no_device, "image '{}' has {} bytes, but {} has memory for {}", name_, bytes_,
                device.name, room);
}

void Image::create() {
  const VkImageCreateInfo info = create_info(shape_);
  check(vkCreateImage(context_->device, &info, nullptr, &objects_->image), "create an image");
  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(context_->device, objects_->image, &requirements);
  objects_->memory =
      allocate_memory(*context_, requirements, MemoryKind::device, bytes_, fmt::format("image '{}'", name_));
  check(vkBindImageMemory(context_->device, objects_->image, objects_->memory, 0), "bind an image's memory");
  auto view = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = objects_->image;
  view.viewType = view_type(shape_.declared);
  view.format = info.format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, info.arrayLayers};
  check(vkCreateImageView(context_->device, &view, nullptr, &objects_->view), "view an image");
}

void Image::upload(std::span<const std::byte> bytes) {
  CHECK_EQ(bytes.size(), bytes_);
  if (!copy_) return;
  std::memcpy(copy_->mapped(), bytes.data(), bytes_);
  if (context_->emulates) return;
  const VkImageCreateInfo info = create_info(shape_);
  context_->begin();
  auto barrier = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;  // the old texels may be lost
  barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = objects_->image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, info.arrayLayers};
  vkCmdPipelineBarrier(context_->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                       VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
  const VkBufferImageCopy region = all_texels(info);
  vkCmdCopyBufferToImage(context_->commands, copy_->handle(), objects_->image, VK_IMAGE_LAYOUT_GENERAL, 1,
                         &region);
  record_barrier(context_->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                 VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_READ_BIT);
  context_->submit_and_wait("copy an image to the device");
}

std::span<const std::byte> Image::read() {
  CHECK(!context_->abandoned);
  if (!copy_) return {};
  if (context_->emulates) return {copy_->mapped(), bytes_};
  context_->begin();
  record_barrier(context_->commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
                 VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
  const VkBufferImageCopy region = all_texels(create_info(shape_));
  vkCmdCopyImageToBuffer(context_->commands, objects_->image, VK_IMAGE_LAYOUT_GENERAL, copy_->handle(), 1,
                         &region);
  record_barrier(context_->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
  context_->submit_and_wait("copy an image from the device");
  return {copy_->mapped(), bytes_};
}

}  // namespace eyeray::engine::gpu
