// An open device, the facts found about it, and the kernels built on it. Successive executors share it, and
// start at once.
#pragma once

#include <list>
#include <memory>
#include <span>
#include <string>

#include "host/core/disk_cache.hpp"
#include "host/core/stopwatch.hpp"
#include "host/executors/options.hpp"
#include "host/gpu/kernel.hpp"
#include "host/gpu/kernel_compiler.hpp"
#include "host/gpu/self_test.hpp"

namespace eyeray::engine::executors {

gpu::DeviceOptions device_options(const GpuOptions& options, bool wide_vectors);

class OpenDevice {
 public:
  // Opens the device that the options select, and tests it. Adds the time to `times`. `wide_vectors`: whether
  // the picture needs them.
  OpenDevice(const GpuOptions& options, bool wide_vectors, StageTimes& times);

  gpu::Device& device() { return device_; }
  const gpu::DeviceFacts& facts() const { return facts_; }
  const DiskCache& cache() const { return cache_; }

  // The kernel of `spirv`. A kernel that was built before is reused if nobody holds it; the buffers of its
  // last use are still bound.
  std::shared_ptr<gpu::Kernel> kernel(std::span<const uint32_t> spirv, const std::string& name);

 private:
  struct Built {
    std::string hash;  // hash of the SPIR-V
    std::shared_ptr<gpu::Kernel> kernel;
  };

  DiskCache cache_ = DiskCache::of_user();
  gpu::Device device_;
  gpu::DeviceFacts facts_;
  std::list<Built> built_;  // the most recently used first
};

// The way that kernels are compiled for the device.
gpu::KernelOptions kernel_options(const GpuOptions& options, OpenDevice& device);

// Error (no_device) if there is no usable device that the options select. Opens none.
void check_device(const GpuOptions& options);

// Opens a device for GpuOptions::open_device. Error (no_device) if no device suffices.
std::shared_ptr<OpenDevice> open_device(const GpuOptions& options);

}  // namespace eyeray::engine::executors
