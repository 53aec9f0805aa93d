// The Vulkan objects of a kernel, for kernel.cpp and command_list.cpp.
#pragma once

#include <set>

#include "gpu/context.hpp"
#include "gpu/kernel.hpp"

namespace eyeray::gpu {

struct Kernel::Objects {
  explicit Objects(std::shared_ptr<Context> the_context) : context(std::move(the_context)) {}
  ~Objects() {
    if (context->abandoned) return;
    vkDestroyPipeline(context->device, pipeline, nullptr);
    vkDestroyPipelineLayout(context->device, layout, nullptr);
    vkDestroyDescriptorPool(context->device, pool, nullptr);
    vkDestroyDescriptorSetLayout(context->device, set_layout, nullptr);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  std::shared_ptr<Context> context;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;  // null when the shader has no buffers
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  std::set<uint32_t> bound;
};

}  // namespace eyeray::gpu
