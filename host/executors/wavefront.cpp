#include "host/executors/wavefront.hpp"

#include <algorithm>

#include "host/core/termination.hpp"

namespace eyeray::engine::executors {

Wavefront::Wavefront(gpu::Device& device, const MakeKernel& make_kernel, const WavefrontOptions& options)
    : device_(device), options_(options) {
  const std::string packets = "kernels/cooperative/packet.comp.glsl", shade = "kernels/wavefront.comp.glsl";
  const std::string stored = "#define STORED_HITS 1\n", listed = "#define LISTED\n";
  eye_.trace = make_kernel(packets, "#define PACKET_PRIMARY\n");
  if (options.shadow_rays > 0) eye_.shadow = make_kernel(packets, "#define PACKET_SHADOW\n");
  eye_.shade = make_kernel(shade, options.splits ? stored + "#define ENDS_ONLY\n" : stored);
  if (options.bounces == 0) return;
  if (options.splits) {
    later_.shade = make_kernel("kernels/render.comp.glsl", listed);
  } else if (options.bounced == Rays::cooperative) {
    const std::string bvh4 = "kernels/cooperative/bvh4.comp.glsl";
    later_.trace = make_kernel(bvh4, "#define BOUNCE_HITS\n");
    if (options.shadow_rays > 0) later_.shadow = make_kernel(bvh4, "#define BOUNCE_SHADOW\n");
    later_.shade = make_kernel(shade, listed + stored);
  } else {
    later_.shade = make_kernel(shade, listed);
  }
}

std::optional<double> Wavefront::run(shader::Dispatch push, gpu::Buffer& results) {
  const uint32_t pixels = Workgroups::pixels(push.tile_width, push.tile_height);
  make_room(push.count);
  for (Bounce* bounce : {&eye_, &later_})
    if (bounce->shade) bounce->shade->set_buffer(BINDING_OUTPUT, results);

  // First the camera rays, their shadow rays, and their shading.
  const auto list_for = [&](Bounce& bounce, gpu::Buffer& list, gpu::Buffer& next) {
    next.clear(sizeof(uint32_t));
    for (gpu::Kernel* kernel : {bounce.trace.get(), bounce.shadow.get(), bounce.shade.get()}) {
      if (!kernel) continue;
      kernel->set_buffer(BINDING_LIST, list);
      kernel->set_buffer(BINDING_NEXT_LIST, next);
    }
  };
  list_for(eye_, *lists_[1], *lists_[0]);
  gpu::CommandList eye_commands(device_);
  run(eye_, push, options_.workgroups.of_packets(pixels), options_.workgroups.of_items(pixels), eye_commands);
  double seconds = eye_commands.run().seconds;

  // Then the paths that go on, bounce by bounce. If rays split, one step finishes them.
  const uint32_t bounces = options_.splits ? std::min(options_.bounces, 1u) : options_.bounces;
  uint32_t& depth = push.depth;
  for (depth = 1; depth <= bounces; ++depth) {
    gpu::Buffer& list = *lists_[(depth + 1) % 2];
    const uint32_t count = list.read_records<uint32_t>(1)[0];
    if (count == 0) break;
    if (interrupted()) return std::nullopt;
    list_for(later_, list, *lists_[depth % 2]);
    gpu::CommandList commands(device_);
    const uint32_t groups = options_.workgroups.of_items(count);
    run(later_, push, groups, groups, commands);
    seconds += commands.run().seconds;
  }
  return seconds;
}

void Wavefront::run(Bounce& bounce, const shader::Dispatch& push, uint32_t trace_groups,
                    uint32_t shade_groups, gpu::CommandList& commands) {
  const auto bytes = std::as_bytes(std::span(&push, 1));
  for (gpu::Kernel* kernel : {bounce.trace.get(), bounce.shadow.get()}) {
    if (!kernel) continue;
    commands.dispatch(*kernel, bytes, {trace_groups, 1, 1});
    commands.barrier();
  }
  commands.dispatch(*bounce.shade, bytes, {shade_groups, 1, 1});
}

void Wavefront::make_room(uint32_t pixels) {
  if (pixels <= pixels_) return;
  pixels_ = pixels;
  hits_.emplace(device_, pixels * sizeof(shader::PacketHit), "hits");
  occlusions_.emplace(device_, pixels * sizeof(uint32_t) * std::max(options_.shadow_rays, 1u), "occlusions");
  paths_.emplace(device_, options_.splits ? 0 : pixels * sizeof(shader::PathState), "paths");
  for (auto& list : lists_) list.emplace(device_, (pixels + 1) * sizeof(uint32_t), "paths that go on");
  for (Bounce* bounce : {&eye_, &later_}) {
    for (gpu::Kernel* kernel : {bounce->trace.get(), bounce->shadow.get(), bounce->shade.get()}) {
      if (!kernel) continue;
      kernel->set_buffer(BINDING_PACKET_HITS, *hits_);
      kernel->set_buffer(BINDING_OCCLUSIONS, *occlusions_);
      kernel->set_buffer(BINDING_PATHS, *paths_);
    }
  }
}

}  // namespace eyeray::engine::executors
