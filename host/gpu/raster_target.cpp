#include "host/gpu/raster_target.hpp"

#include <algorithm>
#include <string>

#include "host/core/error.hpp"
#include "host/gpu/memory.hpp"

namespace eyeray::engine::gpu {
namespace {

constexpr size_t pixel_bytes = 4;  // pixel bytes of each image

struct AttachmentType {
  const char* name;
  VkFormat format;
  VkFormatFeatureFlags feature;
  VkImageUsageFlags usage;
  VkImageAspectFlags aspect;
  VkImageLayout layout;
};
constexpr AttachmentType attachment_types[] = {
    {"the picture's ids", VK_FORMAT_R32_UINT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    {"the picture's depths", VK_FORMAT_D32_SFLOAT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
};

VkImageMemoryBarrier transition(VkImage image, VkImageAspectFlags aspect, VkImageLayout from,
                                VkImageLayout to, VkAccessFlags written, VkAccessFlags seen_as) {
  auto barrier = make<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = written;
  barrier.dstAccessMask = seen_as;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, 1, 0, 1};
  return barrier;
}

constexpr VkPipelineStageFlags drawing_stages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags drawing_accesses =
    VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

void check_size(const DeviceInfo& device, uint32_t width, uint32_t height) {
  if (std::max(width, height) > device.limits.drawn_size)
    throw Error(ExitCode::no_device,
                "{} draws pictures of at most {} pixels a side, but this one has {}×{}: leave out --raster, "
                "or make the picture smaller",
                device.name, device.limits.drawn_size, width, height);
  const uint64_t bytes = uint64_t{width} * height * pixel_bytes;
  if (bytes > std::min(device.limits.allocation, device.limits.heap / 2))
    throw Error(ExitCode::no_device,
                "drawing {}×{} pixels takes two images of {} bytes, but {} has memory for {} (heap of {}): "
                "leave out --raster, or make the picture smaller",
                width, height, bytes, device.name, device.limits.allocation, device.limits.heap);
}

}  // namespace

RasterTarget::RasterTarget(std::shared_ptr<Context> context, uint32_t width, uint32_t height)
    : context_(std::move(context)), width_(width), height_(height) {
  check_size(context_->info, width, height);
  try {
    create();
  } catch (...) {
    if (!context_->abandoned) destroy();
    throw;
  }
}

RasterTarget::~RasterTarget() {
  if (!context_->abandoned) destroy();
}

void RasterTarget::destroy() {
  context_->cancel();
  vkDestroyFramebuffer(context_->device, framebuffer_, nullptr);
  vkDestroyRenderPass(context_->device, pass_, nullptr);
  for (const Attachment& attachment : attachments_) {
    vkDestroyImageView(context_->device, attachment.view, nullptr);
    vkDestroyImage(context_->device, attachment.image, nullptr);
    vkFreeMemory(context_->device, attachment.memory, nullptr);
  }
}

void RasterTarget::create() {
  for (size_t i = 0; i < attachments_.size(); ++i) {
    create_attachment(i);
    copies_[i] = std::make_unique<RawBuffer>(context_, size_t{width_} * height_ * pixel_bytes,
                                             MemoryKind::host, attachment_types[i].name);
  }
  create_pass();
  auto info = make<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  const VkImageView views[] = {attachments_[0].view, attachments_[1].view};
  info.renderPass = pass_;
  info.attachmentCount = 2;
  info.pAttachments = views;
  info.width = width_;
  info.height = height_;
  info.layers = 1;
  check(vkCreateFramebuffer(context_->device, &info, nullptr, &framebuffer_), "create a framebuffer");
  clear();
}

void RasterTarget::create_attachment(size_t index) {
  const AttachmentType& type = attachment_types[index];
  Attachment& attachment = attachments_[index];
  VkFormatProperties format;
  vkGetPhysicalDeviceFormatProperties(context_->physical, type.format, &format);
  if (!(format.optimalTilingFeatures & type.feature))
    throw Error(ExitCode::no_device, "{} cannot draw {} as 32 bits a pixel: leave out --raster",
                context_->info.name, type.name);

  auto image = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  image.imageType = VK_IMAGE_TYPE_2D;
  image.format = type.format;
  image.extent = {width_, height_, 1};
  image.mipLevels = 1;
  image.arrayLayers = 1;
  image.samples = VK_SAMPLE_COUNT_1_BIT;
  image.tiling = VK_IMAGE_TILING_OPTIMAL;
  image.usage = type.usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  image.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  check(vkCreateImage(context_->device, &image, nullptr, &attachment.image), "create an image");
  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(context_->device, attachment.image, &requirements);
  attachment.memory =
      allocate_memory(*context_, requirements, MemoryKind::device, requirements.size, type.name);
  check(vkBindImageMemory(context_->device, attachment.image, attachment.memory, 0),
        "bind an image's memory");

  auto view = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = attachment.image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = type.format;
  view.subresourceRange = {type.aspect, 0, 1, 0, 1};
  check(vkCreateImageView(context_->device, &view, nullptr, &attachment.view), "view an image");
}

// Makes a render pass that keeps the present contents, so that several submissions may draw one picture.
void RasterTarget::create_pass() {
  VkAttachmentDescription descriptions[2] = {};
  VkAttachmentReference references[2] = {};
  for (uint32_t i = 0; i < 2; ++i) {
    descriptions[i].format = attachment_types[i].format;
    descriptions[i].samples = VK_SAMPLE_COUNT_1_BIT;
    descriptions[i].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    descriptions[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    descriptions[i].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    descriptions[i].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    descriptions[i].initialLayout = descriptions[i].finalLayout = attachment_types[i].layout;
    references[i] = {i, attachment_types[i].layout};
  }
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &references[0];
  subpass.pDepthStencilAttachment = &references[1];
  // Earlier submissions' drawing comes first.
  VkSubpassDependency earlier = {};
  earlier.srcSubpass = VK_SUBPASS_EXTERNAL;
  earlier.dstSubpass = 0;
  earlier.srcStageMask = earlier.dstStageMask = drawing_stages;
  earlier.srcAccessMask = earlier.dstAccessMask = drawing_accesses;
  auto info = make<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  info.attachmentCount = 2;
  info.pAttachments = descriptions;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = 1;
  info.pDependencies = &earlier;
  check(vkCreateRenderPass(context_->device, &info, nullptr, &pass_), "create a render pass");
}

// Sets all ids and depths to 0.
void RasterTarget::clear() {
  context_->begin();
  const VkCommandBuffer commands = context_->commands;
  VkImageMemoryBarrier before[2], after[2];
  for (size_t i = 0; i < 2; ++i) {
    before[i] = transition(attachments_[i].image, attachment_types[i].aspect, VK_IMAGE_LAYOUT_UNDEFINED,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0, VK_ACCESS_TRANSFER_WRITE_BIT);
    after[i] =
        transition(attachments_[i].image, attachment_types[i].aspect, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   attachment_types[i].layout, VK_ACCESS_TRANSFER_WRITE_BIT, drawing_accesses);
  }
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0,
                       nullptr, 0, nullptr, 2, before);
  const VkClearColorValue no_id = {};
  const VkClearDepthStencilValue no_depth = {};
  vkCmdClearColorImage(commands, attachments_[0].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &no_id, 1,
                       &before[0].subresourceRange);
  vkCmdClearDepthStencilImage(commands, attachments_[1].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                              &no_depth, 1, &before[1].subresourceRange);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, drawing_stages, 0, 0, nullptr, 0, nullptr, 2,
                       after);
  context_->submit_and_wait("clear a picture");
}

// Copies an image, and makes it ready for drawing again.
void RasterTarget::record_copy(size_t index) const {
  const AttachmentType& type = attachment_types[index];
  const VkImage image = attachments_[index].image;
  const auto before = transition(image, type.aspect, type.layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 drawing_accesses, VK_ACCESS_TRANSFER_READ_BIT);
  const auto after =
      transition(image, type.aspect, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, type.layout, 0, drawing_accesses);
  VkBufferImageCopy region = {};
  region.imageSubresource = {type.aspect, 0, 0, 1};
  region.imageExtent = {width_, height_, 1};
  const VkCommandBuffer commands = context_->commands;
  vkCmdPipelineBarrier(commands, drawing_stages, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1,
                       &before);
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, copies_[index]->handle(), 1,
                         &region);
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, drawing_stages, 0, 0, nullptr, 0, nullptr, 1,
                       &after);
}

void RasterTarget::record_copies() const {
  for (size_t i = 0; i < attachments_.size(); ++i) record_copy(i);
  record_barrier(context_->commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                 VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
}

}  // namespace eyeray::engine::gpu
