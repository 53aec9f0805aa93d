// The target of drawing (an image of ids and one of depths), and its render pass; for the .cpp files of this
// layer.
#pragma once

#include <array>
#include <memory>

#include "host/gpu/context.hpp"
#include "host/gpu/raw_buffer.hpp"

namespace eyeray::engine::gpu {

class RasterTarget {
 public:
  // Makes a target with ids and depths of 0. Error (no_device) with the numbers if the device draws no
  // picture of that size, or has too little memory.
  RasterTarget(std::shared_ptr<Context> context, uint32_t width, uint32_t height);
  ~RasterTarget();
  RasterTarget(const RasterTarget&) = delete;
  RasterTarget& operator=(const RasterTarget&) = delete;

  VkExtent2D extent() const { return {width_, height_}; }
  VkRenderPass pass() const { return pass_; }
  VkFramebuffer framebuffer() const { return framebuffer_; }
  // Records, in the context's command buffer, copies of ids and depths to memory that the processor sees.
  // ids() and depths() are valid once the buffer was submitted and waited for.
  void record_copies() const;
  const uint32_t* ids() const { return reinterpret_cast<const uint32_t*>(copies_[0]->mapped()); }
  const float* depths() const { return reinterpret_cast<const float*>(copies_[1]->mapped()); }

 private:
  struct Attachment {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
  };

  void create();
  void create_attachment(size_t index);
  void create_pass();
  void clear();
  void record_copy(size_t index) const;
  void destroy();

  std::shared_ptr<Context> context_;
  uint32_t width_, height_;
  std::array<Attachment, 2> attachments_;  // ids, depths
  std::array<std::unique_ptr<RawBuffer>, 2> copies_;
  VkRenderPass pass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

}  // namespace eyeray::engine::gpu
