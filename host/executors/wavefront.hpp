// Pictures by wavefronts: rays of all pixels of a tile at once, coherent ones in packets
// (kernels/cooperative/packet.comp.glsl), then those of the pixels whose paths go on.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "host/gpu/command_list.hpp"
#include "host/records/records.hpp"

namespace eyeray {

struct WavefrontOptions {
  bool whitted = false;  // else raycast: no shadow rays, and no path goes on
  uint32_t lights = 0;
  uint32_t depth = 0;  // reflections or refractions in a row, at most
  bool paths = false;  // each is a wavefront of its own (kernels/wavefront.comp.glsl), where no ray splits in
                       // two; else kernels/render.comp.glsl starts the pixels anew whose paths go on
  uint32_t stride = 1;    // GROUP_STRIDE
  uint32_t subgroup = 8;  // lanes
};

class Wavefront {
 public:
  // The kernel of an entry under defines, with the scene's buffers bound.
  using MakeKernel =
      std::function<std::unique_ptr<gpu::Kernel>(const std::string& entry, const std::string& defines)>;

  Wavefront(gpu::Device& device, const MakeKernel& make_kernel, const WavefrontOptions& options);

  // One sample of every pixel of push.tile, as SampleResults; the seconds it took. Nothing when interrupted.
  std::optional<double> run(shader::Dispatch push, gpu::Buffer& results);

 private:
  void make_room(uint32_t pixels);
  uint32_t round_up_to_stride(uint32_t groups) const;

  gpu::Device& device_;
  WavefrontOptions options_;
  std::unique_ptr<gpu::Kernel> primary_;
  std::unique_ptr<gpu::Kernel> shadow_;  // null without shadow rays
  std::unique_ptr<gpu::Kernel> first_;   // shades what eye rays hit
  std::unique_ptr<gpu::Kernel> later_;   // goes on with the paths that do; null where none does
  uint32_t pixels_ = 0;                  // that the buffers have room for
  std::optional<gpu::Buffer> hits_, occlusions_, paths_, lists_[2];
};

}  // namespace eyeray
