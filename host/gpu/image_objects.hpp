// The Vulkan objects of an image, for image.cpp and kernel.cpp.
#pragma once

#include "host/gpu/image.hpp"
#include "host/gpu/raw_buffer.hpp"

namespace eyeray::engine::gpu {

// All null on the emulator. The image stays in the layout GENERAL.
struct Image::Objects {
  explicit Objects(std::shared_ptr<Context> the_context) : context(std::move(the_context)) {}
  ~Objects() {
    if (context->abandoned || context->emulates) return;
    vkDestroyImageView(context->device, view, nullptr);
    vkDestroyImage(context->device, image, nullptr);
    vkFreeMemory(context->device, memory, nullptr);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  std::shared_ptr<Context> context;
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

}  // namespace eyeray::engine::gpu
