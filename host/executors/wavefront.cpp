#include "host/executors/wavefront.hpp"

#include <algorithm>

#include "host/core/termination.hpp"

namespace eyeray {

Wavefront::Wavefront(gpu::Device& device, const MakeKernel& make_kernel, const WavefrontOptions& options)
    : device_(device), options_(options) {
  primary_ = make_kernel("kernels/cooperative/packet.comp.glsl", "#define PACKET_PRIMARY\n");
  const std::string stored = "#define STORED_HITS 1\n";
  if (!options.whitted) {
    first_ = make_kernel("kernels/render.comp.glsl", stored);
    return;
  }
  if (options.lights > 0)
    shadow_ = make_kernel("kernels/cooperative/packet.comp.glsl", "#define PACKET_SHADOW\n");
  first_ =
      make_kernel("kernels/wavefront.comp.glsl", options.paths ? stored : stored + "#define ENDS_ONLY\n");
  if (options.depth == 0) return;
  later_ = options.paths ? make_kernel("kernels/wavefront.comp.glsl", "")
                         : make_kernel("kernels/render.comp.glsl", "#define LISTED\n");
}

std::optional<double> Wavefront::run(shader::Dispatch push, gpu::Buffer& results) {
  const auto bytes = std::as_bytes(std::span(&push, 1));
  const uint32_t blocks = (push.tile.z + 7) / 8 * ((push.tile.w + 7) / 8);  // of 8 × 8 pixels
  const uint32_t rays_a_group = 64 / options_.subgroup * PACKET;
  const uint32_t packet_groups = round_up_to_stride((blocks * 64 + rays_a_group - 1) / rays_a_group);
  make_room(push.tile.z * push.tile.w);

  // The eye rays and their shadow rays, and what they see.
  lists_[0]->clear(sizeof(uint32_t));
  first_->set_buffer(BINDING_OUTPUT, results);
  first_->set_buffer(BINDING_LIST, *lists_[1]);
  first_->set_buffer(BINDING_NEXT_LIST, *lists_[0]);
  gpu::CommandList commands(device_);
  commands.dispatch(*primary_, bytes, {packet_groups, 1, 1});
  commands.barrier();
  if (shadow_) {
    commands.dispatch(*shadow_, bytes, {packet_groups, 1, 1});
    commands.barrier();
  }
  commands.dispatch(*first_, bytes, {round_up_to_stride(blocks), 1, 1});
  double seconds = commands.run().seconds;

  // Then the paths that go on, each alone: wave after wave, or all the way.
  const uint32_t waves = options_.paths ? options_.depth : 1;
  uint32_t& depth = push.sample_index.y;
  for (depth = 1; later_ && depth <= waves; ++depth) {
    gpu::Buffer& list = *lists_[(depth + 1) % 2];
    gpu::Buffer& next = *lists_[depth % 2];
    const uint32_t count = list.read_records<uint32_t>(1)[0];
    if (count == 0) break;
    if (interrupted()) return std::nullopt;
    next.clear(sizeof(uint32_t));
    later_->set_buffer(BINDING_OUTPUT, results);
    later_->set_buffer(BINDING_LIST, list);
    later_->set_buffer(BINDING_NEXT_LIST, next);
    seconds += gpu::dispatch(device_, *later_, bytes, {round_up_to_stride((count + 63) / 64), 1, 1}).seconds;
  }
  return seconds;
}

void Wavefront::make_room(uint32_t pixels) {
  if (pixels <= pixels_) return;
  pixels_ = pixels;
  hits_.emplace(device_, pixels * sizeof(shader::PacketHit), "packet hits");
  occlusions_.emplace(device_, pixels * sizeof(uint32_t) * std::max(options_.lights, 1u), "occlusions");
  paths_.emplace(device_, options_.paths ? pixels * sizeof(shader::PathState) : 0, "paths");
  for (auto& list : lists_) list.emplace(device_, (pixels + 1) * sizeof(uint32_t), "paths that go on");
  for (gpu::Kernel* kernel : {primary_.get(), shadow_.get(), first_.get(), later_.get()}) {
    if (!kernel) continue;
    kernel->set_buffer(BINDING_PACKET_HITS, *hits_);
    kernel->set_buffer(BINDING_OCCLUSIONS, *occlusions_);
    kernel->set_buffer(BINDING_PATHS, *paths_);
  }
}

// As many workgroups as make runs of equal length (kernels/tile.glsl).
uint32_t Wavefront::round_up_to_stride(uint32_t groups) const {
  return (groups + options_.stride - 1) / options_.stride * options_.stride;
}

}  // namespace eyeray
