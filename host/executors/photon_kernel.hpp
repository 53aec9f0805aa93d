// Emits a sample's photons on a device, and hands them to the kernels that gather them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "host/executors/photon_list.hpp"
#include "host/executors/scene_kernels.hpp"
#include "host/executors/workgroups.hpp"
#include "host/gpu/dispatch_size.hpp"

namespace eyeray::engine::executors {

class PhotonKernel {
 public:
  // Device, kernels and times must outlive it. Both this and send_out throw Error (no_device), with the
  // numbers, if the device has no room for so many photons.
  PhotonKernel(gpu::Device& device, SceneKernels& kernels, StageTimes& times, const Workgroups& workgroups,
               const PhotonSettings& settings, const Vec3& eye);

  // Emits the photons of sample `index`, for kernels to gather, unless they are the present ones. Returns
  // false when interrupted.
  bool send_out(uint32_t index, std::span<const uint32_t> left_out);
  // Binds the buffers of the photons to the kernel.
  void bind(gpu::Kernel& kernel) const;
  // Possible faults of the photons that were emitted last: SampleFlags.
  uint32_t flags() const { return flags_; }
  double longest_dispatch() const { return longest_dispatch_; }  // seconds, so far

 private:
  bool trace(uint32_t index);
  void make_room(uint32_t photons);

  gpu::Device& device_;
  SceneKernels& kernels_;
  StageTimes& times_;
  Workgroups workgroups_;
  PhotonSettings settings_;
  Vec3 eye_;
  std::shared_ptr<gpu::Kernel> kernel_;
  gpu::DispatchSize dispatch_size_;
  uint32_t capacity_ = 0;
  uint32_t stored_ = 0;
  gpu::Buffer pass_, results_, count_;
  std::optional<gpu::Buffer> found_, photons_, cells_;
  std::optional<uint32_t> sample_;  // the sample of the present photons,
  uint64_t choice_ = 0;             // and their choice of tunables
  uint32_t flags_ = 0;
  double longest_dispatch_ = 0;
};

}  // namespace eyeray::engine::executors
