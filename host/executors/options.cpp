#include "host/executors/options.hpp"

#include "host/bvh/history.hpp"

namespace eyeray::engine::executors {

bool repay_kernels(int64_t samples) {
  // From this many samples on, a second of compiling saves more than a second of rendering.
  return samples >= 1 << 24;
}

ExecutorOptions for_frames(ExecutorOptions options, int64_t samples) {
  options.gpu.constants = options.gpu.constants && repay_kernels(samples);
  if (!options.pack.history) options.pack.history = std::make_shared<bvh::BvhHistory>();
  return options;
}

}  // namespace eyeray::engine::executors
