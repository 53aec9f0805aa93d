// The Vulkan objects of a kernel, for kernel.cpp and command_list.cpp.
#pragma once

#include <map>
#include <set>
#include <utility>

#include "host/gpu/context.hpp"
#include "host/gpu/kernel.hpp"

namespace eyeray::engine::gpu {

struct Kernel::Objects {
  explicit Objects(std::shared_ptr<Context> the_context) : context(std::move(the_context)) {}
  ~Objects() {
    if (context->abandoned || context->emulates) return;
    for (const auto& [binding, view] : views) vkDestroyBufferView(context->device, view, nullptr);
    vkDestroySampler(context->device, sampler, nullptr);
    vkDestroyPipeline(context->device, pipeline, nullptr);
    vkDestroyPipelineLayout(context->device, layout, nullptr);
    vkDestroyDescriptorPool(context->device, pool, nullptr);
    vkDestroyDescriptorSetLayout(context->device, set_layout, nullptr);
  }
  Objects(const Objects&) = delete;
  Objects& operator=(const Objects&) = delete;

  // Makes a view of a buffer's texels for `binding`, in place of the view that was bound there before.
  VkBufferView make_view(uint32_t binding, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize bytes) {
    auto info = gpu::make<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
    info.buffer = buffer;
    info.format = VK_FORMAT_R32G32B32A32_UINT;
    info.offset = offset;
    info.range = bytes;
    VkBufferView view = VK_NULL_HANDLE;
    check(vkCreateBufferView(context->device, &info, nullptr, &view), "view a buffer as texels");
    vkDestroyBufferView(context->device, std::exchange(views[binding], view), nullptr);
    return view;
  }

  // The sampler of images that are combined with one. Texels are read by their coordinates, so it decides
  // nothing.
  VkSampler any_sampler() {
    const auto info = gpu::make<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    if (!sampler) check(vkCreateSampler(context->device, &info, nullptr, &sampler), "create a sampler");
    return sampler;
  }

  std::shared_ptr<Context> context;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;  // null when the shader has no buffers
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;
  bool dispatched = false;  // at least once
  std::set<uint32_t> bound;
  std::map<uint32_t, VkBufferView> views;
  std::unique_ptr<const emulator::Kernel> emulated;  // on the emulator, which has none of the above
  std::map<uint32_t, std::span<std::byte>> spans;    // by binding, there
  std::map<uint32_t, emulator::Image> images;        // likewise
};

}  // namespace eyeray::engine::gpu
