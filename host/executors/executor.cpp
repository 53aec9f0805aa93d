#include "host/executors/executor.hpp"

#include "host/executors/executors.hpp"

namespace eyeray {

std::unique_ptr<Executor> make_executor(Backend backend, const Scene& scene, const ExecutorOptions& options) {
  if (backend == Backend::gpu) return make_gpu_executor(scene, options);
  if (backend == Backend::twin) return make_twin_executor(scene, options);
  return make_reference_executor(scene, options);
}

}  // namespace eyeray
