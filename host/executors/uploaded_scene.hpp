// A packed scene in a device's memory.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "host/executors/scene_buffers.hpp"
#include "host/gpu/buffer.hpp"
#include "host/gpu/kernel.hpp"

namespace eyeray::engine::executors {

class UploadedScene {
 public:
  // `texels`: whether to make texel buffers where SceneBuffer::texels allows it. `device` must outlive the
  // scene.
  UploadedScene(gpu::Device& device, bool texels) : device_(device), texels_(texels) {}

  // Uploads a buffer. Error (no_device) if the device has too little memory for this buffer and the earlier
  // ones.
  void add(const SceneBuffer& source);
  // Binds the buffers added so far to the kernel.
  void bind(gpu::Kernel& kernel) const;
  // The bytes of geometry and of the BVHs over it.
  uint64_t geometry_bytes() const { return geometry_bytes_; }

 private:
  gpu::Device& device_;
  bool texels_;
  std::vector<std::pair<uint32_t, gpu::Buffer>> buffers_;  // by binding
  uint64_t bytes_ = 0;
  uint64_t geometry_bytes_ = 0;
};

}  // namespace eyeray::engine::executors
