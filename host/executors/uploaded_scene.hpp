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
  // `texels`: whether buffers that may be are texel buffers. `device` must outlive it.
  UploadedScene(gpu::Device& device, bool texels) : device_(device), texels_(texels) {}

  // Error (no_device) where the device has too little memory for it and those before.
  void add(const SceneBuffer& source);
  // Gives the kernel the buffers so far.
  void bind(gpu::Kernel& kernel) const;
  // Bytes that geometry and the BVHs over it take.
  uint64_t geometry_bytes() const { return geometry_bytes_; }

 private:
  gpu::Device& device_;
  bool texels_;
  std::vector<std::pair<uint32_t, gpu::Buffer>> buffers_;  // by binding
  uint64_t bytes_ = 0;
  uint64_t geometry_bytes_ = 0;
};

}  // namespace eyeray::engine::executors
