// Renders pictures by wavefronts: all pixels of a tile, one bounce at a time, with a kernel for each step.
// Camera rays and their shadow rays, which are coherent, are traced in packets. The profile sets the way of
// tracing the rays of later bounces. Every bounce is shaded by kernels/wavefront.comp.glsl, which lists the
// pixels whose paths go on.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "host/executors/profile.hpp"
#include "host/executors/workgroups.hpp"
#include "host/gpu/buffer.hpp"
#include "host/gpu/command_list.hpp"
#include "host/records/records.hpp"

namespace eyeray::engine::executors {

struct WavefrontOptions {
  uint32_t shadow_rays = 0;  // shadow rays of each hit
  uint32_t bounces = 0;      // the most bounces after the camera ray
  // True if rays split in two. Then kernels/render.comp.glsl restarts the pixels whose paths go on.
  bool splits = false;
  // The way of tracing the rays of later bounces and their shadow rays: `lanes` while they are shaded, or
  // `cooperative` by separate kernels.
  Rays bounced = Rays::lanes;
  Workgroups workgroups;
};

class Wavefront {
 public:
  // Makes the kernel of an entry with these defines, and binds the scene's buffers.
  using MakeKernel =
      std::function<std::shared_ptr<gpu::Kernel>(const std::string& entry, const std::string& defines)>;

  Wavefront(gpu::Device& device, const MakeKernel& make_kernel, const WavefrontOptions& options);

  // Writes one sample of every pixel of push's tile to `results`, as SampleResults. Returns the seconds that
  // it took; nothing when interrupted.
  std::optional<double> run(shader::Dispatch push, gpu::Buffer& results);

 private:
  // The kernels of a bounce: for its rays, their shadow rays, and their shading. Null if another kernel does
  // the step.
  struct Bounce {
    std::shared_ptr<gpu::Kernel> trace, shadow, shade;
  };

  void run(Bounce& bounce, const shader::Dispatch& push, uint32_t trace_groups, uint32_t shade_groups,
           gpu::CommandList& commands);
  void make_room(uint32_t pixels);

  gpu::Device& device_;
  WavefrontOptions options_;
  Bounce eye_, later_;
  uint32_t pixels_ = 0;  // the pixels for which the buffers have room
  std::optional<gpu::Buffer> hits_, occlusions_, paths_, lists_[2];
};

}  // namespace eyeray::engine::executors
